#include "lychnite/optics/surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "lychnite/optics/fresnel.h"

namespace lychnite {
namespace {

double ggxDistribution(double cosH, double alpha) {
  const double a2 = alpha * alpha;
  const double d = cosH * cosH * (a2 - 1) + 1;
  return a2 / (std::numbers::pi * d * d);
}

/// G2 / (4 cos_i cos_o).
double smithVisibility(double cosI, double cosO, double alpha) {
  const double a2 = alpha * alpha;
  const double shadowing = cosO * std::sqrt(a2 + (1 - a2) * cosI * cosI);
  const double masking = cosI * std::sqrt(a2 + (1 - a2) * cosO * cosO);
  return 0.5 / (shadowing + masking);
}

}  // namespace

Rgb surfaceResponse(const SurfaceCoat& coat, const glm::dvec3& n, const glm::dvec3& wo,
                    const glm::dvec3& wi) {
  const double cosI = glm::dot(n, wi), cosO = glm::dot(n, wo);
  if (cosI <= 0 || cosO <= 0) return Rgb(0);
  const double alpha = coat.roughness * coat.roughness;
  const glm::dvec3 h = glm::normalize(wi + wo);
  const double fresnel = fresnelReflectance(glm::dot(h, wi), coat.eta);
  const double specular =
      fresnel * ggxDistribution(glm::dot(n, h), alpha) * smithVisibility(cosI, cosO, alpha);
  const double base = fresnelTransmittance(cosI, coat.eta) * exitLobe(cosO, coat.eta);
  return (Rgb(specular) + coat.base * base) * cosI;
}

}  // namespace lychnite
