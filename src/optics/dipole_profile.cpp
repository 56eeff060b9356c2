#include <cmath>
#include <numbers>

#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/profile.h"

namespace lychnite {
namespace {

/// The standard dipole of [J01] eq. 4; its tail integral P is d/dr-exact (docs/physics.md, "The dipole").
class DipoleProfile final : public Profile {
 public:
  explicit DipoleProfile(const Coefficients& m) : sigma_tr_(m.sigma_tr()), albedo_p_(m.albedo_p()) {
    const double Fdr = diffuseFresnelReflectance(m.eta);
    const double A = (1 + Fdr) / (1 - Fdr);
    for (int c = 0; c < 3; ++c) {
      const double sigma_tp = m.sigma_tp()[c];
      zr_[c] = sigma_tp > 0 ? 1 / sigma_tp : 0;
      zv_[c] = zr_[c] * (1 + 4 * A / 3);
    }
  }

  Rgb Rd(double r) const override {
    Rgb result(0);
    for (int c = 0; c < 3; ++c)
      if (albedo_p_[c] > 0)
        result[c] = albedo_p_[c] / (4 * std::numbers::pi) *
                    (flux(r, zr_[c], sigma_tr_[c]) + flux(r, zv_[c], sigma_tr_[c]));
    return result;
  }

  Rgb P(double r) const override {
    Rgb result(0);
    for (int c = 0; c < 3; ++c)
      if (albedo_p_[c] > 0)
        result[c] = 0.5 * albedo_p_[c] * (tail(r, zr_[c], sigma_tr_[c]) + tail(r, zv_[c], sigma_tr_[c]));
    return result;
  }

  Rgb coreLength() const override { return zr_; }
  Rgb tailDecay() const override { return sigma_tr_; }

 private:
  static double flux(double r, double z, double sigma_tr) {
    const double d = std::sqrt(r * r + z * z);
    return z * (1 + sigma_tr * d) * std::exp(-sigma_tr * d) / (d * d * d);
  }
  static double tail(double r, double z, double sigma_tr) {
    const double d = std::sqrt(r * r + z * z);
    return z * std::exp(-sigma_tr * d) / d;
  }

  Rgb sigma_tr_, albedo_p_, zr_, zv_;
};

}  // namespace

std::unique_ptr<Profile> makeDipole(const Coefficients& coefficients) {
  return std::make_unique<DipoleProfile>(coefficients);
}

}  // namespace lychnite
