#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lychnite/base/log.h"
#include "lychnite/base/progress.h"
#include "lychnite/image/image.h"
#include "lychnite/scene/scene.h"
#include "lychnite/scene/settings.h"

namespace lychnite {

struct RendererOptions {
  std::string device = "auto";     ///< auto, gpu, cpu or an index of `lychnite devices`
  bool debug = false;              ///< treat OpenGL debug errors as failures
  bool useCurrentContext = false;  ///< draw in the EGL context current on this thread, e.g. a window's
  LogSink log;
  ProfileMaker profiles;  ///< empty: formulas only (lychnite/optics/profile.h)
};

/// What the last render cost.
struct RenderStats {
  struct Pass {
    std::string name;
    double gpuMs = 0;  ///< GPU timer; on a software driver, the time its threads took
    int runs = 0;      ///< 0 when the pass was not needed because nothing it depends on changed
  };
  std::vector<Pass> passes;
  double frameMs = 0;  ///< wall time of render(), read-back included
  std::string device, driver;
  bool software = false;
  size_t triangles = 0, vertices = 0, coveredPixels = 0;
  int mapSize = 0;                    ///< texels along a side of the light-space maps
  size_t mapBytes = 0, gpuBytes = 0;  ///< light-space maps; everything this renderer holds on the device
};

/// The real-time renderer: scene in, picture out, no window. Call render() again and again; only what changed
/// since the last call is uploaded or redrawn, and nothing is precomputed: light, material, size, camera and
/// meshes may change every frame. One thread at a time, the one that made it.
class Renderer {
 public:
  /// Throws Error (Kind::kDevice) when no OpenGL 4.5 is to be had.
  explicit Renderer(const RendererOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Linear picture with coverage and the AOVs asked for. Validates both arguments. Throws Error.
  Image render(const Scene& scene, const RenderSettings& settings, const Progress& progress = {});
  /// The same without reading anything back: the picture stays on the device, where RendererTextures
  /// (src/technique/renderer_textures.h) finds it. Never waits for the device: the passes' times are those of
  /// the newest frame that it has finished. Throws Error.
  void draw(const Scene& scene, const RenderSettings& settings);
  const RenderStats& stats() const;

 private:
  friend struct RendererTextures;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lychnite
