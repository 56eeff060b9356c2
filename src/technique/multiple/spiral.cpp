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

std::vector<glm::vec2> azimuthTable() {
  std::vector<glm::vec2> table;
  table.reserve(size_t(kAzimuthColumns) * size_t(kAzimuthRows));
  for (int row = 0; row < kAzimuthRows; ++row) {
    const double e = kLargestEccentricity * row / (kAzimuthRows - 1);
    for (int column = 0; column < kAzimuthColumns; ++column) {
      const double turn = double(column) / (kAzimuthColumns - 1);
      const double phi = warpedAzimuth(2 * std::numbers::pi * (turn - 0.5), e);
      table.emplace_back(std::cos(phi), std::sin(phi));
    }
  }
  return table;
}

double spiralReach(const Profile& profile) {
  const Rgb total = profile.P(0);
  double r = 1e-9;
  for (; r < 1e9; r *= 1.2) {
    const Rgb left = profile.P(r);
    if (left.x <= 1e-3 * total.x && left.y <= 1e-3 * total.y && left.z <= 1e-3 * total.z) break;
  }
  return r;
}

double spiralScale(const Profile& profile) {
  const Rgb core = profile.coreLength();
  const int channels = (core.x > 0) + (core.y > 0) + (core.z > 0);
  return channels > 0 ? (core.x + core.y + core.z) * 3 / channels : 1;
}

}  // namespace lychnite
