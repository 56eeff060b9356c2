#include "reference/walk_guide.h"

#include <algorithm>
#include <cmath>

namespace lychnite {

void WalkGuideSamples::merge(const WalkGuideSamples& other) {
  for (size_t i = 0; i < count.size(); ++i) {
    count[i] += other.count[i];
    squares[i] += other.squares[i];
  }
}

namespace {

/// Sums over cubes of 2^level cells, at cell resolution.
double around(const std::vector<float>& values, size_t cell, int level) {
  constexpr size_t n = WalkGuideSamples::kCells;
  const size_t side = size_t(1) << level;
  const size_t x = cell % n / side * side, y = cell / n % n / side * side, z = cell / (n * n) / side * side;
  double sum = 0;
  for (size_t k = z; k < z + side; ++k)
    for (size_t j = y; j < y + side; ++j)
      for (size_t i = x; i < x + side; ++i) sum += double(values[(k * n + j) * n + i]);
  return sum;
}

/// Root of a cell's mean square; from its surroundings where the pilot saw too little of it.
double rootMeanSquare(const WalkGuideSamples& samples, size_t cell) {
  for (int level = 0; level <= 5; ++level) {
    const double count = around(samples.count, cell, level);
    if (count >= 16 || level == 5)
      return count > 0 ? std::sqrt(around(samples.squares, cell, level) / count) : 1;
  }
  return 1;
}

}  // namespace

WalkGuide::WalkGuide(const WalkGuideSamples& samples, double photons, double work)
    : chance_(samples.count.size()) {
  std::vector<double> root(chance_.size());
  for (size_t i = 0; i < root.size(); ++i) root[i] = rootMeanSquare(samples, i);
  const double largest = *std::max_element(root.begin(), root.end());
  if (!(largest > 0)) {
    std::fill(chance_.begin(), chance_.end(), kLeast);
    return;
  }
  // Per photon, variance = sum of count root^2 / chance and cost = work + sum of count chance, chance =
  // min(1, root/l).
  double bestProduct = 0, best = largest;
  for (double l = largest; l > 1e-4 * largest; l *= 0.8) {
    double variance = 0, cost = work;
    for (size_t i = 0; i < root.size(); ++i) {
      if (samples.count[i] <= 0) continue;
      const double chance = std::clamp(root[i] / l, double(kLeast), 1.0);
      variance += double(samples.count[i]) / photons * root[i] * root[i] / chance;
      cost += double(samples.count[i]) / photons * chance;
    }
    if (bestProduct == 0 || variance * cost < bestProduct) {
      bestProduct = variance * cost;
      best = l;
    }
  }
  for (size_t i = 0; i < root.size(); ++i) chance_[i] = float(root[i] / best);
}

}  // namespace lychnite
