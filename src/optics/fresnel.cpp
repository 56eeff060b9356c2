#include "lychnite/optics/fresnel.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace lychnite {
namespace {

/// Integral of f over [0, 1] by the composite midpoint rule after mu = t^2 (3 - 2 t), which flattens both
/// ends, where the Fresnel terms have square-root behaviour.
template <class F>
double integrateUnit(F f) {
  constexpr int kSteps = 2048;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps;
    sum += f(t * t * (3 - 2 * t)) * 6 * t * (1 - t);
  }
  return sum / kSteps;
}

/// Walsh 1926, "The reflection factor of a polished glass surface for diffused light": the mean reflectance
/// of an index n > 1 from outside, exact; close to 1 its terms cancel.
double walshReflectance(double n) {
  const double n2 = n * n, n4 = n2 * n2, sum = n2 + 1, difference = n4 - 1;
  return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
         n2 * (n2 - 1) * (n2 - 1) / (sum * sum * sum) * std::log((n - 1) / (n + 1)) -
         2 * n * n2 * (n2 + 2 * n - 1) / (sum * difference) +
         8 * n4 * (n4 + 1) / (sum * difference * difference) * std::log(n);
}

}  // namespace

double fresnelReflectance(double cosI, double eta) {
  if (eta == 1) return 0;
  cosI = std::clamp(cosI, 0.0, 1.0);
  const double sin2T = (1 - cosI * cosI) / (eta * eta);
  if (sin2T >= 1) return 1;
  const double cosT = std::sqrt(1 - sin2T);
  const double parallel = (eta * cosI - cosT) / (eta * cosI + cosT);
  const double perpendicular = (cosI - eta * cosT) / (cosI + eta * cosT);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

double fresnelTransmittance(double cosI, double eta) {
  return 1 - fresnelReflectance(cosI, eta);
}

double diffuseFresnelReflectance(double eta) {
  if (eta == 1) return 0;
  if (eta > 2) return 1 - diffuseTransmittanceOutside(eta) / (eta * eta);
  if (eta > 1) return -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta;
  return -0.4399 + 0.7099 / eta - 0.3319 / (eta * eta) + 0.0636 / (eta * eta * eta);
}

double diffuseTransmittanceOutside(double eta) {
  // What enters from within is what leaves from outside, spread over the wider cone (d'Eon & Irving 2011).
  if (eta < 1) return eta * eta * diffuseTransmittanceOutside(1 / eta);
  if (eta == 1) return 1;
  if (eta > 1.001) return 1 - walshReflectance(eta);
  return 2 * integrateUnit([eta](double mu) { return fresnelTransmittance(mu, eta) * mu; });
}

double internalMoment(double eta, int i) {
  if (eta == 1) return 0;
  // Split at the critical angle, beyond which everything is reflected: the integrand has a corner there.
  const double muCritical = std::sqrt(std::max(0.0, 1 - 1 / (eta * eta)));
  const double total = std::pow(muCritical, i + 1) / (i + 1);
  const double width = 1 - muCritical;
  return total + width * integrateUnit([&](double t) {
                   const double mu = muCritical + width * t;
                   return fresnelReflectance(mu, 1 / eta) * std::pow(mu, i);
                 });
}

double exitLobe(double cosO, double eta) {
  return fresnelTransmittance(cosO, eta) / (std::numbers::pi * diffuseTransmittanceOutside(eta));
}

std::optional<glm::dvec3> refract(const glm::dvec3& d, const glm::dvec3& n, double eta) {
  const double cosI = -glm::dot(d, n);
  const double sin2T = (1 - cosI * cosI) / (eta * eta);
  if (sin2T >= 1) return std::nullopt;
  return glm::normalize(d / eta + n * (cosI / eta - std::sqrt(1 - sin2T)));
}

}  // namespace lychnite
