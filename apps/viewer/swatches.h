#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "display.h"
#include "lychnite/technique/renderer.h"

namespace lychnite::viewer {

/// Small pictures of the material library: a sphere of the subject's size in each, lit from behind.
class Swatches {
 public:
  explicit Swatches(const RendererOptions& options);

  /// What they should show. Cheap when nothing changed.
  void want(double size, int pixels, const ToneMapping& toneMapping);
  /// Draws one that is out of date; false when all are as wanted.
  bool drawOne(Display& display);
  /// Null until it was drawn for the first time.
  const gpu::Texture* texture(size_t material) const;

 private:
  struct Swatch {
    gpu::Texture texture;
    gpu::Framebuffer framebuffer;
    std::string key;
  };
  RendererOptions options_;
  std::unique_ptr<Renderer> renderer_;
  std::vector<std::optional<Swatch>> swatches_;
  Scene scene_;
  ToneMapping toneMapping_;
  int pixels_ = 0;
  std::string key_;
};

}  // namespace lychnite::viewer
