#pragma once

#include <glm/vec3.hpp>

#include "lychnite/base/vec.h"

namespace lychnite {

/// A dielectric coat (GGX microfacets) over a Lambertian base; the base is black for a translucent object,
/// whose own light comes from inside.
struct SurfaceCoat {
  double eta = 1.3;        ///< inside over outside
  double roughness = 0.3;  ///< GGX alpha = roughness^2
  Rgb base{0};             ///< albedo of the base
};

/// BRDF times cos_i, 1/sr. `n` unit normal, `wo` towards the viewer, `wi` towards the light, all unit and
/// pointing away from the surface. 0 when either is behind. Specular: Walter et al. 2007 eq. 20 with exact
/// Fresnel, D of eq. 33 and the height-correlated Smith masking-shadowing of Heitz 2014 eq. 99. Base: light
/// enters and leaves by Ft, like scattered light (docs/physics.md).
Rgb surfaceResponse(const SurfaceCoat& coat, const glm::dvec3& n, const glm::dvec3& wo, const glm::dvec3& wi);

}  // namespace lychnite
