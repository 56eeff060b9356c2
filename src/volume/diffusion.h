#pragma once

#include <cmath>
#include <vector>

#include "lychnite/optics/coefficients.h"
#include "volume/surface.h"

namespace lychnite::volume {

/// One channel's diffusion constants in any one unit of length (docs/volume.md): -D phi'' + sigma_a phi = Q
/// with Grosjean's D (d'Eon & Irving 2011 eq. 17), and the Robin boundary's zb = 2 A D with the exact A
/// (ibid. eq. 9).
struct Diffusion {
  double D = 1, sigma_a = 0, zb = 0;
  double k = 0;  ///< sqrt(sigma_a / D), at least 1e-3
  double sigma_tp = 1, albedo_p = 0;

  Diffusion() = default;
  Diffusion(double sigma_sp, double absorption, double eta);

  // Under a plane surface: u(z) = sinh(kz)/k + zb cosh(kz) is the fluence of light that diffuses out of it,
  // v(z) = sinh(kz)/k that of light kept from it at z = 0.

  /// 1 / u(d): flux out of the surface per unit of D phi at depth d.
  double perFluence(double d) const { return 2 * std::exp(-k * d) / scaledU(d); }
  /// (u'(d) - 1) / u(d): power absorbed in the layer above depth d, per unit of area and D phi at d.
  double absorbedAbove(double d) const {
    const double e = std::exp(-k * d), e2 = e * e;
    return ((1 + e2) + zb * k * (1 - e2) - 2 * e) / scaledU(d);
  }
  /// v(d - z) / u(d): share of a source at depth z < d that leaves through the surface.
  double leaving(double z, double d) const {
    return z < d ? std::exp(-k * z) * -std::expm1(-2 * k * (d - z)) / (k * scaledU(d)) : 0;
  }
  /// u(z) / u(d): share of it that reaches depth d; what is missing is absorbed on the way.
  double staying(double z, double d) const {
    return z < d ? std::exp(-k * (d - z)) * scaledU(z) / scaledU(d) : 1;
  }

  /// The same shares of a beam from the surface down to depth `end` <= d that collides `a` times per depth.
  double beamLeaving(double a, double end, double d) const {
    return a / (k * scaledU(d)) * (exponential(0, -(a + k), end) - exponential(-2 * k * d, k - a, end));
  }
  double beamStaying(double a, double end, double d) const {
    return a / scaledU(d) *
           ((1 / k + zb) * exponential(-k * d, k - a, end) +
            (zb - 1 / k) * exponential(-k * d, -(a + k), end));
  }

  /// Fourier transform at wave number q (radians per length) of a half-space's diffuse reflectance profile: a
  /// source and its mirror image, as in Jensen et al. 2001, with this D and zb.
  double response(double q) const {
    const double zr = 1 / sigma_tp, s = std::sqrt(q * q + sigma_a / D);
    return 0.5 * albedo_p * (std::exp(-zr * s) + std::exp(-(zr + 2 * zb) * s));
  }

 private:
  /// 2 exp(-kz) u(z).
  double scaledU(double z) const {
    const double e = std::expm1(-2 * k * z);
    return -e / k + zb * (2 + e);
  }
  /// Integral of exp(b + c z) from 0 to `end`, for b <= 0 and b + c end <= 0.
  static double exponential(double b, double c, double end) {
    const double x = c * end;
    if (std::abs(x) < 1e-9) return std::exp(b) * end;
    return std::abs(x) < 1 ? std::exp(b) * std::expm1(x) / c : (std::exp(b + x) - std::exp(b)) / c;
  }
};

/// The three channels of an object's medium, reduced coefficients in local units.
struct DiffusionRgb {
  DiffusionRgb() = default;
  DiffusionRgb(const Coefficients& local);
  Diffusion channel[3];
};

/// The diffusion equation on a grid: for each channel, D sum over links of g (phi - phi') + (sigma_a V + sum
/// over samples of a D / u(d)) phi = Q. Rebuilt for a new medium or size, solved for each light.
class DiffusionSystem {
 public:
  DiffusionSystem(const Grid& grid, const Surface& surface, const DiffusionRgb& medium);

  struct Report {
    int iterations = 0;
    double residual = 0;  ///< |Q - A phi| / |Q|, largest of the channels
  };
  /// Conjugate gradients for all channels at once, preconditioned by the diagonal, from the `phi` given
  /// (empty for 0). Sums are taken in fixed blocks: the same bits on any number of threads.
  Report solve(const std::vector<Lanes>& Q, std::vector<Lanes>& phi, double tolerance) const;

  /// Flux that leaves at each node: sum over its samples of a phi D / u(d).
  void exits(const std::vector<Lanes>& phi, std::vector<Lanes>& nodes) const;
  /// The source of each cell for which a cell's solution is what a unit source of it makes of weights at the
  /// nodes: the sum of weight times exit. (The equation is symmetric.)
  void sourcesOfExits(const std::vector<Lanes>& weights, std::vector<Lanes>& Q) const;
  /// Power absorbed in the cells: sum of sigma_a V phi.
  Rgb absorbed(const std::vector<Lanes>& phi) const;
  const DiffusionRgb& medium() const { return medium_; }
  size_t memoryBytes() const { return (diagonal_.capacity() + exit_.capacity()) * sizeof(Lanes); }

 private:
  void findAbsorption();
  void multiply(const std::vector<Lanes>& x, std::vector<Lanes>& y, std::vector<Lanes>& dots) const;

  const Grid& grid_;
  const Surface& surface_;
  DiffusionRgb medium_;
  Lanes D_;
  std::vector<Lanes> exit_;        ///< a / u(d) of each sample
  std::vector<Lanes> absorption_;  ///< of each cell, over D
  std::vector<Lanes> diagonal_;    ///< of the matrix over D
};

}  // namespace lychnite::volume
