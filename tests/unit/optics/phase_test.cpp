#include "lychnite/optics/phase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace lychnite {
namespace {

constexpr double kAsymmetries[]{-0.9, -0.3, -1e-5, 0, 1e-5, 0.1, 0.5, 0.9};

/// Moment `n` of cosTheta over the sphere, midpoints.
double moment(double g, int n) {
  constexpr int kSteps = 200000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double c = -1 + (i + 0.5) * 2 / kSteps;
    sum += henyeyGreenstein(c, g) * std::pow(c, n);
  }
  return sum * 2 / kSteps * 2 * std::numbers::pi;
}

TEST(HenyeyGreenstein, IsNormalisedAndHasItsMeanCosine) {
  for (double g : kAsymmetries) {
    EXPECT_NEAR(moment(g, 0), 1, 1e-6) << g;
    EXPECT_NEAR(moment(g, 1), g, 1e-6) << g;
    // Legendre moments are powers of g: the mean of (3 c^2 - 1)/2 is g^2.
    EXPECT_NEAR(1.5 * moment(g, 2) - 0.5, g * g, 2e-6) << g;
  }
}

TEST(HenyeyGreenstein, KnownValues) {
  EXPECT_NEAR(henyeyGreenstein(0.3, 0), 1 / (4 * std::numbers::pi), 1e-15);
  EXPECT_NEAR(henyeyGreenstein(1, 0.5), 0.75 / (4 * std::numbers::pi * 0.125), 1e-14);
  EXPECT_NEAR(henyeyGreenstein(-1, 0.5), 0.75 / (4 * std::numbers::pi * 3.375), 1e-14);
}

TEST(SampleHenyeyGreenstein, InvertsTheDistribution) {
  // The share below the sampled cosine is u: numeric integral up to it.
  for (double g : kAsymmetries)
    for (double u : {0.0, 0.05, 0.3, 0.5, 0.8, 0.99}) {
      const double c = sampleHenyeyGreenstein(u, g);
      ASSERT_GE(c, -1);
      ASSERT_LE(c, 1);
      constexpr int kSteps = 40000;
      double share = 0;
      for (int i = 0; i < kSteps; ++i) share += henyeyGreenstein(-1 + (c + 1) * (i + 0.5) / kSteps, g);
      share *= 2 * std::numbers::pi * (c + 1) / kSteps;
      EXPECT_NEAR(share, u, 1e-5) << g << " " << u;
    }
}

TEST(SampleHenyeyGreenstein, StrataHaveTheMeanCosine) {
  for (double g : kAsymmetries) {
    double sum = 0;
    constexpr int kStrata = 10000;
    for (int i = 0; i < kStrata; ++i) sum += sampleHenyeyGreenstein((i + 0.5) / kStrata, g);
    EXPECT_NEAR(sum / kStrata, g, 1e-4) << g;
  }
}

TEST(Deflect, TurnsByTheAngleInEveryDirection) {
  for (const glm::dvec3& d :
       {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0),
        glm::normalize(glm::dvec3(0.3, -0.5, -1e-9)), glm::normalize(glm::dvec3(-1, 2, -3))})
    for (double c : {-1.0, -0.4, 0.0, 0.7, 1.0}) {
      glm::dvec3 mean(0);
      constexpr int kTurns = 16;
      for (int i = 0; i < kTurns; ++i) {
        const glm::dvec3 t = deflect(d, c, 2 * std::numbers::pi * i / kTurns);
        EXPECT_NEAR(glm::length(t), 1, 1e-14);
        EXPECT_NEAR(glm::dot(t, d), c, 1e-12);
        mean += t / double(kTurns);
      }
      // A full turn about d leaves only the part along d.
      EXPECT_NEAR(glm::distance(mean, c * d), 0, 1e-12);
    }
}

}  // namespace
}  // namespace lychnite
