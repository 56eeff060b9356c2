#include <cmath>
#include <numbers>

#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/profile.h"

namespace lychnite {
namespace {

/// One channel of d'Eon 2012, "A Better Dipole": Grosjean's diffusion for two mirrored point sources, the
/// exitance a combination of fluence and flux. Lengths in mm.
struct Poles {
  double strength = 0;           ///< alpha_p^2: scattered once at the source, and again by Grosjean's term
  double zr = 0, zv = 0;         ///< distances of the real and the virtual source from the surface
  double D = 0, sigma_tr = 0;    ///< Grosjean's diffusion coefficient (mm) and its decay (1/mm)
  double fluence = 0, flux = 0;  ///< C_phi and C_E: weights of the two in the exitance

  double Rd(double r) const {
    const auto [dr, er] = to(zr, r);
    const auto [dv, ev] = to(zv, r);
    const double phi = (er / dr - ev / dv) / D;
    const double e =
        zr * (1 + sigma_tr * dr) * er / (dr * dr * dr) + zv * (1 + sigma_tr * dv) * ev / (dv * dv * dv);
    return strength / (4 * std::numbers::pi) * (fluence * phi + flux * e);
  }

  /// The integral of Rd 2 pi r' from r outwards, closed because r' dr' = d dd for both poles.
  double P(double r) const {
    const auto [dr, er] = to(zr, r);
    const auto [dv, ev] = to(zv, r);
    const double gap = (zv * zv - zr * zr) / (dv + dr);
    const double phi = sigma_tr > 0 ? -er * std::expm1(-sigma_tr * gap) / sigma_tr : gap;
    return 0.5 * strength * (fluence * phi / D + flux * (zr * er / dr + zv * ev / dv));
  }

 private:
  struct Reach {
    double distance, decay;
  };
  Reach to(double z, double r) const {
    const double d = std::sqrt(r * r + z * z);
    return {d, std::exp(-sigma_tr * d)};
  }
};

Poles makePoles(double sigma_sp, double sigma_a, double eta) {
  Poles p;
  if (sigma_sp <= 0) return p;
  const double sigma_tp = sigma_sp + sigma_a;
  const double twoC1 = 2 * internalMoment(eta, 1), threeC2 = 3 * internalMoment(eta, 2);
  p.strength = (sigma_sp / sigma_tp) * (sigma_sp / sigma_tp);
  p.D = (2 * sigma_a + sigma_sp) / (3 * sigma_tp * sigma_tp);
  p.sigma_tr = std::sqrt(sigma_a / p.D);
  p.zr = 1 / sigma_tp;
  p.zv = p.zr + 4 * p.D * (1 + threeC2) / (1 - twoC1);  // the extrapolated boundary lies at 2 A D
  p.fluence = 0.25 * (1 - twoC1);
  p.flux = 0.5 * (1 - threeC2);
  return p;
}

class BetterDipole final : public Profile {
 public:
  explicit BetterDipole(const Coefficients& m) {
    for (int c = 0; c < 3; ++c) poles_[c] = makePoles(m.sigma_sp()[c], m.sigma_a[c], m.eta);
  }

  Rgb Rd(double r) const override {
    return channels([r](const Poles& p) { return p.strength > 0 ? p.Rd(r) : 0; });
  }
  Rgb P(double r) const override {
    return channels([r](const Poles& p) { return p.strength > 0 ? p.P(r) : 0; });
  }
  Rgb coreLength() const override {
    return channels([](const Poles& p) { return p.zr; });
  }
  Rgb tailDecay() const override {
    return channels([](const Poles& p) { return p.sigma_tr; });
  }

 private:
  template <class F>
  Rgb channels(F f) const {
    return {f(poles_[0]), f(poles_[1]), f(poles_[2])};
  }

  Poles poles_[3];
};

}  // namespace

std::unique_ptr<Profile> makeBetterDipole(const Coefficients& coefficients) {
  return std::make_unique<BetterDipole>(coefficients);
}

}  // namespace lychnite
