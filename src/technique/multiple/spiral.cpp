#include "technique/multiple/spiral.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace lychnite {

double warpedAzimuth(double m, double e) {
  assert(e >= 0 && e < 1 && std::abs(m) <= std::numbers::pi + 1e-12);
  // Monotone in phi and convex on either side of 0: bisection to be safe at large e, then Newton's digits.
  double low = -std::numbers::pi, high = std::numbers::pi;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (low + high);
    (middle + e * std::sin(middle) < m ? low : high) = middle;
  }
  double phi = 0.5 * (low + high);
  for (int i = 0; i < 4; ++i) phi -= (phi + e * std::sin(phi) - m) / (1 + e * std::cos(phi));
  return phi;
}

std::vector<glm::vec2> azimuthTable(int samples, int rows) {
  std::vector<glm::vec2> table;
  table.reserve(size_t(samples) * size_t(rows));
  for (int row = 0; row < rows; ++row) {
    const double e = kLargestEccentricity * row / (rows - 1);
    for (int i = 0; i < samples; ++i) {
      const double turn = i * (std::numbers::phi - 1);
      const double phi = warpedAzimuth(2 * std::numbers::pi * (turn - std::floor(turn) - 0.5), e);
      table.emplace_back(std::cos(phi), std::sin(phi));
    }
  }
  return table;
}

}  // namespace lychnite
