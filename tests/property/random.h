#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "lychnite/optics/coefficients.h"

namespace lychnite {

/// The same numbers on every machine and in every run.
class Random {
 public:
  explicit Random(uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }
  /// Spread evenly over the orders of magnitude.
  double logUniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  Rgb rgb(double low, double high) { return {uniform(low, high), uniform(low, high), uniform(low, high)}; }
  Rgb logRgb(double low, double high) {
    return {logUniform(low, high), logUniform(low, high), logUniform(low, high)};
  }
  bool coin() { return engine_() & 1; }
  glm::dvec3 direction() {
    const double z = uniform(-1, 1), phi = uniform(0, 6.283185307179586), r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  /// Anything that validate() takes, from glass to black: some channels clear, some that only absorb.
  Coefficients medium() {
    Coefficients m{
        .sigma_s = logRgb(1e-3, 1e3), .sigma_a = logRgb(1e-5, 1e3), .g = uniform(-0.95, 0.95), .eta = 1};
    for (int c = 0; c < 3; ++c) {
      if (uniform(0, 1) < 0.1) m.sigma_a[c] = 0;
      if (uniform(0, 1) < 0.05) m.sigma_s[c] = 0;
    }
    if (uniform(0, 1) < 0.9) m.eta = uniform(1, 4);
    return m;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace lychnite
