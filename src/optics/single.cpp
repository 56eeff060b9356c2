#include "lychnite/optics/single.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lychnite {

double refractedDistance(double s, double cosI, double eta) {
  if (eta == 1) return s;
  const double angle = std::asin(std::sin(std::acos(std::clamp(cosI, -1.0, 1.0))) / eta);
  return s * cosI / std::cos(angle);
}

double freePath(double u, double sigma, double end) {
  if (sigma * end < 1e-12) return u * end;
  return -std::log1p(u * std::expm1(-sigma * end)) / sigma;
}

double freePathDensity(double s, double sigma, double end) {
  if (sigma * end < 1e-12) return 1 / end;
  return -sigma * std::exp(-sigma * s) / std::expm1(-sigma * end);
}

double leaveSphere(const glm::dvec3& o, const glm::dvec3& d, const glm::dvec3& centre, double radius) {
  const glm::dvec3 towards = centre - o;
  const double middle = glm::dot(towards, d);
  const double off = glm::length(towards - d * middle);
  if (off >= radius) return 0;
  return std::max(0.0, middle + std::sqrt((radius - off) * (radius + off)));
}

}  // namespace lychnite
