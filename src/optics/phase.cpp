#include "lychnite/optics/phase.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace lychnite {

double henyeyGreenstein(double cosTheta, double g) {
  const double d = std::max(1e-12, 1 + g * g - 2 * g * cosTheta);
  return (1 - g * g) / (4 * std::numbers::pi * d * std::sqrt(d));
}

double sampleHenyeyGreenstein(double u, double g) {
  // Below this the exact inversion loses more digits than the linear term it approaches has.
  if (std::abs(g) < 1e-4) return std::clamp(2 * u - 1 + 3 * g * 2 * u * (1 - u), -1.0, 1.0);
  const double s = (1 - g * g) / (1 - g + 2 * g * u);
  return std::clamp((1 + g * g - s * s) / (2 * g), -1.0, 1.0);
}

glm::dvec3 deflect(const glm::dvec3& d, double cosTheta, double phi) {
  // Duff et al. 2017, "Building an orthonormal basis, revisited".
  const double sign = std::copysign(1.0, d.z);
  const double a = -1 / (sign + d.z);
  const double b = d.x * d.y * a;
  const glm::dvec3 t(1 + sign * d.x * d.x * a, sign * b, -sign * d.x);
  const glm::dvec3 s(b, sign + d.y * d.y * a, -d.y);
  const double sinTheta = std::sqrt(std::max(0.0, 1 - cosTheta * cosTheta));
  return glm::normalize(d * cosTheta + (t * std::cos(phi) + s * std::sin(phi)) * sinTheta);
}

}  // namespace lychnite
