#include "lychnite/optics/single.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lychnite {
namespace {

TEST(RefractedDistance, StraightWhereNothingBends) {
  EXPECT_DOUBLE_EQ(refractedDistance(3, 1, 1.5), 3);
  for (double c : {0.0, 0.3, 1.0}) EXPECT_DOUBLE_EQ(refractedDistance(3, c, 1), 3);
}

TEST(RefractedDistance, IsTheFormulaOfThePaper) {
  // s' = s |w.n| / sqrt(1 - (1 - |w.n|^2)/eta^2) at 60 degrees and eta 1.5.
  EXPECT_NEAR(refractedDistance(2, 0.5, 1.5), 1 / std::sqrt(1 - 0.75 / 2.25), 1e-14);
}

TEST(FreePath, GoesFromTheStartToTheEnd) {
  for (double sigma : {0.0, 1e-9, 0.5, 30.0}) {
    EXPECT_DOUBLE_EQ(freePath(0, sigma, 2), 0);
    EXPECT_NEAR(freePath(1, std::min(sigma, 5.0), 2), 2, 1e-9);
  }
  EXPECT_NEAR(freePath(0.5, 1, 1e3), std::log(2.0), 1e-12);
}

TEST(FreePath, DensityIsTheDerivativeOfItsInverse) {
  for (double sigma : {0.0, 1e-6, 0.5, 5.0})
    for (double u : {0.1, 0.5, 0.9}) {
      constexpr double kStep = 1e-5;
      const double slope = (freePath(u + kStep, sigma, 2) - freePath(u - kStep, sigma, 2)) / (2 * kStep);
      EXPECT_NEAR(freePathDensity(freePath(u, sigma, 2), sigma, 2) * slope, 1, 1e-5) << sigma << " " << u;
    }
}

TEST(LeaveSphere, FromInsideOutsideAndBesides) {
  const glm::dvec3 centre(1, 2, 3);
  EXPECT_DOUBLE_EQ(leaveSphere(centre, {0, 0, 1}, centre, 2), 2);
  EXPECT_DOUBLE_EQ(leaveSphere(centre - glm::dvec3(0, 0, 5), {0, 0, 1}, centre, 2), 7);
  EXPECT_DOUBLE_EQ(leaveSphere(centre + glm::dvec3(0, 0, 5), {0, 0, 1}, centre, 2), 0) << "behind";
  EXPECT_DOUBLE_EQ(leaveSphere(centre + glm::dvec3(3, 0, 0), {0, 0, 1}, centre, 2), 0) << "missed";
  EXPECT_NEAR(leaveSphere(centre + glm::dvec3(2, 0, 0), {-1, 0, 0}, centre, 2), 4, 1e-12)
      << "from the surface";
}

}  // namespace
}  // namespace lychnite
