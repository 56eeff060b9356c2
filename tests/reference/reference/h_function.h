#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace lychnite {

/// Chandrasekhar's H function of isotropic scattering on a Gauss-Legendre grid, by iterating
/// 1/H(mu) = sqrt(1 - a) + a/2 integral of H(m) m / (mu + m) dm [Chandrasekhar 1960, ch. V, eq. (16)].
class HFunction {
 public:
  explicit HFunction(double albedo) : albedo_(albedo) {
    for (int i = 0; i < kNodes; ++i) addNode(i);
    H_.assign(kNodes, 1.0);
    for (int round = 0; round < 2000; ++round) {
      std::vector<double> next(kNodes);
      for (size_t i = 0; i < kNodes; ++i) next[i] = 0.5 * (H_[i] + at(mu_[i]));
      H_.swap(next);
    }
  }
  double at(double mu) const {
    double integral = 0;
    for (size_t i = 0; i < kNodes; ++i) integral += weight_[i] * H_[i] * mu_[i] / (mu + mu_[i]);
    return 1 / (std::sqrt(1 - albedo_) + 0.5 * albedo_ * integral);
  }
  /// Plane albedo 1 - H(mu) sqrt(1 - a).
  double reflectance(double mu) const { return 1 - at(mu) * std::sqrt(1 - albedo_); }
  double diffuseAlbedo() const {
    double sum = 0;
    for (size_t i = 0; i < kNodes; ++i) sum += 2 * weight_[i] * mu_[i] * reflectance(mu_[i]);
    return sum;
  }

 private:
  static constexpr int kNodes = 48;

  void addNode(int i) {  // Newton on the Legendre polynomial, mapped to [0, 1]
    double x = std::cos(std::numbers::pi * (i + 0.75) / (kNodes + 0.5)), slope = 0;
    for (int round = 0; round < 100; ++round) {
      double p0 = 1, p1 = x;
      for (int n = 2; n <= kNodes; ++n) p0 = std::exchange(p1, ((2 * n - 1) * x * p1 - (n - 1) * p0) / n);
      slope = kNodes * (x * p1 - p0) / (x * x - 1);
      x -= p1 / slope;
    }
    mu_.push_back(0.5 * (x + 1));
    weight_.push_back(1 / ((1 - x * x) * slope * slope));
  }

  double albedo_;
  std::vector<double> mu_, weight_, H_;
};

}  // namespace lychnite
