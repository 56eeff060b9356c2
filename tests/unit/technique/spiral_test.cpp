#include "technique/multiple/spiral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lychnite {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Spiral, AzimuthSolvesItsEquation) {
  for (const double e : {0.0, 0.3, 0.9})
    for (int i = 0; i <= 200; ++i) {
      const double m = kPi * (i / 100.0 - 1);
      const double phi = warpedAzimuth(m, e);
      EXPECT_NEAR(phi + e * std::sin(phi), m, 1e-9) << e << " " << m;
      EXPECT_LE(std::abs(phi), kPi + 1e-9);
    }
}

// The share of azimuths below phi is (phi + e sin phi + pi) / 2 pi when their density is (1 + e cos phi) / 2
// pi.
TEST(Spiral, TableFollowsTheDensity) {
  const auto table = azimuthTable();
  ASSERT_EQ(table.size(), size_t(kAzimuthColumns * kAzimuthRows));
  for (const int row : {0, 31, 63}) {
    const double e = kLargestEccentricity * row / (kAzimuthRows - 1);
    int towards = 0;
    for (int i = 0; i + 1 < kAzimuthColumns; ++i) {
      const glm::vec2 direction = table[size_t(row * kAzimuthColumns + i)];
      EXPECT_NEAR(std::hypot(direction.x, direction.y), 1, 1e-6);
      towards += direction.x > 0;
    }
    EXPECT_NEAR(towards, (kAzimuthColumns - 1) * (0.5 + e / kPi), 2) << e;
    const glm::vec2 first = table[size_t(row * kAzimuthColumns)],
                    last = table[size_t((row + 1) * kAzimuthColumns - 1)];
    EXPECT_NEAR(first.x, last.x, 1e-6) << "a full turn";
    EXPECT_NEAR(first.y, last.y, 1e-6);
  }
}

}  // namespace
}  // namespace lychnite
