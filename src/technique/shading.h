#pragma once

#include "technique/shading_inputs.h"

namespace lychnite {

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
