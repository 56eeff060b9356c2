#include <algorithm>
#include <cmath>
#include <numbers>

#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/profile.h"

namespace lychnite {
namespace {

/// Diffuse albedo of an index-matched half-space of reduced albedo alpha_p (van de Hulst's fit, of which
/// albedoFromColour is the inverse).
double diffuseAlbedo(double alpha_p) {
  const double s = std::sqrt(1 - alpha_p);
  return (1 - s) * (1 - 0.139 * s) / (1 + 1.17 * s);
}

/// One channel of Christensen & Burley 2015, "Approximate Reflectance Profiles for Efficient Subsurface
/// Scattering".
struct Exponentials {
  double A = 0;       ///< total diffuse reflectance
  double length = 1;  ///< l / s in mm
  double core = 0;    ///< mm; below it Rd is its mean over the disc of this radius

  double Rd(double r) const {
    if (r < core) return (P(0) - P(core)) / (std::numbers::pi * core * core);
    return A * (std::exp(-r / length) + std::exp(-r / (3 * length))) / (8 * std::numbers::pi * length * r);
  }
  double P(double r) const { return 0.25 * A * (std::exp(-r / length) + 3 * std::exp(-r / (3 * length))); }
};

Exponentials makeExponentials(double sigma_sp, double sigma_a, double eta) {
  Exponentials e;
  if (sigma_sp <= 0) return e;
  const double A = diffuseAlbedo(sigma_sp / (sigma_sp + sigma_a));
  // Their shape for diffuse transmission at the surface, because P(0) is defined under uniform light (their
  // other one is for a perpendicular pencil, and that of the diffuse mean free path would need a length we do
  // not have).
  const double s = 1.9 - A + 3.5 * (A - 0.8) * (A - 0.8);
  const double Fdr = 2 * internalMoment(eta, 1);
  // Saunderson 1942: what the surface sends back inside comes out with the same albedo.
  e.A = A * (1 - Fdr) / (1 - A * Fdr);
  e.length = 1 / ((sigma_sp + sigma_a) * s);
  e.core = 1e-3 * e.length;
  return e;
}

class NormalizedDiffusion final : public Profile {
 public:
  explicit NormalizedDiffusion(const Coefficients& m) {
    for (int c = 0; c < 3; ++c) channel_[c] = makeExponentials(m.sigma_sp()[c], m.sigma_a[c], m.eta);
  }

  Rgb Rd(double r) const override {
    return channels([r](const Exponentials& e) { return e.Rd(r); });
  }
  Rgb P(double r) const override {
    return channels([r](const Exponentials& e) { return e.P(r); });
  }
  Rgb coreLength() const override {
    return channels([](const Exponentials& e) { return e.length; });
  }
  Rgb tailDecay() const override {
    return channels([](const Exponentials& e) { return 1 / (3 * e.length); });
  }

 private:
  template <class F>
  Rgb channels(F f) const {
    Rgb result(0);
    for (int c = 0; c < 3; ++c)
      if (channel_[c].A > 0) result[c] = f(channel_[c]);
    return result;
  }

  Exponentials channel_[3];
};

}  // namespace

std::unique_ptr<Profile> makeNormalizedDiffusion(const Coefficients& coefficients) {
  return std::make_unique<NormalizedDiffusion>(coefficients);
}

}  // namespace lychnite
