#pragma once

#include <optional>

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

 private:
  gpu::Program adaptive_, fixed_;
};

/// Multiple scattering by the matched sampler.
class MultipleMatchedShading {
 public:
  MultipleMatchedShading();
  bool update(Layer& layer, const ShadingInputs& in, size_t light);

 private:
  const gpu::Texture& azimuths(int samples);

  gpu::Program program_;
  std::optional<gpu::Texture> azimuths_;
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
