#include "optics/smooth_curve.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace lychnite {
namespace {

constexpr double kLevel = 1e-3;  // weight of first differences: nothing beside any measured value
constexpr size_t kBand = 4;

/// Symmetric, positive definite, non-zero at most three off the diagonal.
class BandMatrix {
 public:
  explicit BandMatrix(size_t n) : rows_(n) {}

  void addDiagonal(size_t i, double value) { rows_[i][0] += value; }
  /// Adds `weight` times the outer product of a stencil that starts at `first`.
  template <size_t N>
  void addStencil(size_t first, const std::array<double, N>& stencil, double weight) {
    static_assert(N <= kBand);
    for (size_t i = 0; i < N; ++i)
      for (size_t j = i; j < N; ++j) rows_[first + i][j - i] += weight * stencil[i] * stencil[j];
  }
  /// Gaussian elimination; leaves the matrix used up.
  std::vector<double> solve(std::vector<double> b) {
    const size_t n = rows_.size();
    for (size_t k = 0; k < n; ++k)
      for (size_t i = 1; i < kBand && k + i < n; ++i) {
        const double factor = rows_[k][i] / rows_[k][0];
        for (size_t j = i; j < kBand; ++j) rows_[k + i][j - i] -= factor * rows_[k][j];
        b[k + i] -= factor * b[k];
      }
    for (size_t k = n; k-- > 0;) {
      for (size_t i = 1; i < kBand && k + i < n; ++i) b[k] -= rows_[k][i] * b[k + i];
      b[k] /= rows_[k][0];
    }
    return b;
  }

 private:
  std::vector<std::array<double, kBand>> rows_;  ///< of row i, columns i, i + 1...
};

}  // namespace

std::vector<double> whittakerSmoothed(const std::vector<double>& values, const std::vector<double>& weights,
                                      double roughness) {
  assert(values.size() == weights.size() && values.size() >= 4);
  const size_t n = values.size();
  BandMatrix matrix(n);
  std::vector<double> right(n);
  for (size_t i = 0; i < n; ++i) {
    matrix.addDiagonal(i, weights[i]);
    right[i] = weights[i] * values[i];
  }
  for (size_t i = 0; i + 4 <= n; ++i) matrix.addStencil<4>(i, {-1, 3, -3, 1}, roughness);
  for (size_t i = 0; i + 2 <= n; ++i) matrix.addStencil<2>(i, {-1, 1}, kLevel);
  return matrix.solve(std::move(right));
}

CurvePoint curveAt(const std::vector<double>& values, double x) {
  const double last = double(values.size() - 1);
  if (x <= 0) return {values.front(), 0};
  if (x >= last) return {values.back(), 0};
  const auto i = std::min(size_t(x), values.size() - 2);
  const double t = x - double(i), p1 = values[i], p2 = values[i + 1];
  const double p0 = i > 0 ? values[i - 1] : p1, p3 = i + 2 < values.size() ? values[i + 2] : p2;
  const double m1 = 0.5 * (p2 - p0), m2 = 0.5 * (p3 - p1);
  const double a = 2 * (p1 - p2) + m1 + m2, b = 3 * (p2 - p1) - 2 * m1 - m2;
  return {((a * t + b) * t + m1) * t + p1, (3 * a * t + 2 * b) * t + m1};
}

}  // namespace lychnite
