#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace lychnite {

/// Linear RGB triple of any per-channel quantity: coefficients (1/mm), irradiance, radiance, albedo.
using Rgb = glm::dvec3;

}  // namespace lychnite
