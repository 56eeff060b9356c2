#pragma once

#include <optional>

#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "lychnite/scene/settings.h"
#include "technique/layer.h"
#include "technique/light_map/light_map_pass.h"
#include "technique/profile_cache.h"

namespace lychnite {

/// What a component of the light is shaded from.
struct ShadingInputs {
  const Frame& frame;
  const GeometryPass& geometry;
  const LightMapPass& maps;
  const ProfileCache& profiles;
  const RenderSettings& settings;
};

/// Multiple scattering by the paper's lattice: `adaptive` and `fixed`.
class MultipleLatticeShading {
 public:
  MultipleLatticeShading();
  bool update(Layer& layer, const ShadingInputs& in, size_t light);
  /// The uniforms of pass/lattice_sampler.glsl.
  void setUniforms(gpu::Program& program, const ShadingInputs& in, size_t object, size_t light);

 private:
  gpu::Program adaptive_, fixed_;
};

/// Multiple scattering by the matched sampler: evaluated for every second pixel and row and interpolated
/// where the surface and its light are smooth, evaluated for each pixel elsewhere.
class MultipleMatchedShading {
 public:
  /// How often the samples of a slanted surface are doubled, at most, against one that faces the light.
  static constexpr int kMostRefinement = 2;

  MultipleMatchedShading();
  bool update(Layer& layer, const ShadingInputs& in, size_t light);
  /// The uniforms of pass/matched_sampler.glsl.
  void setUniforms(gpu::Program& program, const ShadingInputs& in, size_t object, size_t light);

 private:
  struct Coarse {
    gpu::Texture radiosity, surface;
    gpu::Framebuffer framebuffer;
  };
  const gpu::Texture& azimuths();
  Coarse& coarse(const CameraFrame& camera);
  void drawCoarse(const ShadingInputs& in, size_t object, size_t light);

  gpu::Program coarseProgram_, program_;
  std::optional<gpu::Texture> azimuths_;
  std::optional<Coarse> coarse_;  ///< shared by all objects and lights
};

/// Single scattering along the refracted ray.
class SingleShading {
 public:
  SingleShading();
  bool update(Layer& layer, const ShadingInputs& in, size_t light);

 private:
  gpu::Program program_;
};

/// The coat, and the base of opaque objects, with shadows.
class SurfaceShading {
 public:
  SurfaceShading();
  bool update(Layer& layer, const ShadingInputs& in, size_t light);

 private:
  gpu::Program program_;
};

/// The uniform surrounding; it has a layer of its own, like one more light.
class AmbientShading {
 public:
  AmbientShading();
  bool update(Layer& layer, const ShadingInputs& in, const Rgb& ambient);

 private:
  gpu::Program program_;
};

}  // namespace lychnite
