#pragma once

#include <map>
#include <optional>
#include <utility>

#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "technique/key.h"
#include "technique/light_map/light_view.h"
#include "technique/mesh_cache.h"

namespace lychnite {

/// Which textures of a light-space map a frame needs.
struct LightMapNeeds {
  int size = 512;
  bool cosine = true;         ///< depth and (w_i . n), with mips [Yao & Wang 2009]
  bool fiveChannels = false;  ///< normal, irradiance and depth, with mips [DS03]
  bool moments = false;       ///< flux and its depth moments, with mips (ours)
  bool farDepth = false;      ///< of translucent objects only
};

/// The translucent shadow maps, one for each object and light, redrawn when the light, the object or an
/// occluder moved.
class LightMapPass {
 public:
  LightMapPass();

  struct Map {
    LightView view;
    std::optional<gpu::Texture> cosine;               ///< RG32F; beside moments its first level alone
    std::optional<gpu::Texture> normal, normalDepth;  ///< RGBA32F, R32F
    std::optional<gpu::Texture> moments;              ///< RGBA32F
    std::optional<gpu::Texture> farDepth;             ///< R32F, one level
    Key key;                                          ///< of everything in it but the light's power
  };

  /// Brings all maps up to date; returns how many were drawn.
  int update(const Frame& frame, const MeshCache& meshes, const LightMapNeeds& needs);
  const Map& get(size_t object, size_t light) const { return maps_.at({object, light}); }
  size_t bytes() const;

 private:
  void draw(Map& map, const Frame& frame, const MeshCache& meshes, size_t object, const LightMapNeeds& needs);
  void drawNearest(gpu::Program& program, gpu::Framebuffer& framebuffer, const Map& map, const Frame& frame,
                   const MeshCache& meshes, size_t object);
  void drawFarthest(Map& map, const Frame& frame, const MeshCache& meshes, size_t object);

  gpu::Program cosineProgram_, normalProgram_, momentsProgram_, farProgram_;
  std::optional<gpu::Texture> depth_;  ///< shared by all maps
  std::map<std::pair<size_t, size_t>, Map> maps_;
};

}  // namespace lychnite
