// The measured profile against the transport it was measured by, run independently, and against itself.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lychnite/optics/fresnel.h"
#include "lychnite/reference/measure_profile.h"
#include "lychnite/reference/slab.h"

namespace lychnite {
namespace {

constexpr double kSigmas = 4;

/// Three channels far apart: nearly no absorption, skin, much absorption; 1/mm.
Coefficients someMedium(double g = 0) {
  return {.sigma_s = Rgb(3.0, 0.9, 0.5) / (1 - g), .sigma_a = Rgb(0.03, 0.1, 0.5), .g = g, .eta = 1.3};
}

MeasuredProfile measured(const Coefficients& medium) {
  return measureProfile(
      {.albedo = medium.albedo(), .g = medium.g, .eta = medium.eta, .photons = 250'000, .seed = 7});
}

TEST(MeasuredProfile, GivesTheHalfSpacesDiffuseReflectance) {
  for (const double g : {0.0, 0.7}) {
    const Coefficients medium = someMedium(g);
    const auto profile = makeTabulated(measured(medium), ProfileOrders::kAll, medium);
    const SlabResult slab =
        simulateSlab({.medium = medium, .diffuse = true, .photons = 300'000, .ringEdges = {}});
    const Rgb expected = slab.diffuse_reflectance.value / diffuseTransmittanceOutside(medium.eta);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(profile->P(0)[c], expected[c], 0.01 * expected[c]) << g << " " << c;
  }
}

TEST(MeasuredProfile, FollowsTheRingsOfAnIndependentRun) {
  const Coefficients medium = someMedium();
  const auto profile = makeTabulated(measured(medium), ProfileOrders::kAll, medium);
  SlabSettings settings{.medium = medium, .diffuse = true, .photons = 600'000, .seed = 3, .ringEdges = {0}};
  for (double r = 0.02; r < 20; r *= 1.5) settings.ringEdges.push_back(r);
  const SlabResult slab = simulateSlab(settings);
  const double entered = diffuseTransmittanceOutside(medium.eta);
  for (size_t i = 1; i + 1 < settings.ringEdges.size(); ++i) {
    const double a = settings.ringEdges[i], b = settings.ringEdges[i + 1];
    const Rgb mean = (profile->P(a) - profile->P(b)) / (std::numbers::pi * (b * b - a * a));
    for (int c = 0; c < 3; ++c) {
      const double expected = slab.radialReflectance[i].value[c] / entered;
      const double error = slab.radialReflectance[i].standardError[c] / entered;
      if (error > 0.1 * expected) continue;
      EXPECT_NEAR(mean[c], expected, kSigmas * 1.6 * error + 0.01 * expected) << a << " mm, channel " << c;
    }
  }
}

TEST(MeasuredProfile, TailIsTheIntegralAndFallsSmoothly) {
  const Coefficients medium = someMedium();
  const MeasuredProfile rings = measured(medium);
  for (const ProfileOrders orders : {ProfileOrders::kAll, ProfileOrders::kFromSecond}) {
    const auto profile = makeTabulated(rings, orders, medium);
    double slopeBefore = 0;
    for (double r = 0.01; r < 15; r *= 1.02) {
      const double next = r * 1.02, middle = std::sqrt(r * next);
      const Rgb passed = profile->P(r) - profile->P(next);
      const double step = std::log(1.02);
      const Rgb expected = profile->Rd(middle) * (2 * std::numbers::pi * middle * middle * step);
      EXPECT_NEAR(passed.y, expected.y, 2e-3 * expected.y) << r;
      EXPECT_LT(profile->Rd(next).y, profile->Rd(r).y);
      // No rings: the slope in log-log never jumps.
      const double slope = std::log(profile->Rd(next).y / profile->Rd(r).y) / step;
      if (slopeBefore != 0) {
        EXPECT_NEAR(slope, slopeBefore, 0.05 + 0.04 * std::abs(slope)) << r;
      }
      slopeBefore = slope;
    }
  }
}

TEST(MeasuredProfile, SecondOrderOnIsLessThanAllByTheFirst) {
  const Coefficients medium = someMedium();
  const MeasuredProfile rings = measured(medium);
  const auto all = makeTabulated(rings, ProfileOrders::kAll, medium);
  const auto more = makeTabulated(rings, ProfileOrders::kFromSecond, medium);
  for (int c = 0; c < 3; ++c) {
    EXPECT_LT(more->P(0)[c], all->P(0)[c]);
    EXPECT_GT(more->P(0)[c], 0.3 * all->P(0)[c]);
  }
  // Far out nothing has been scattered but once.
  EXPECT_NEAR(more->Rd(10).x, all->Rd(10).x, 0.03 * all->Rd(10).x);
}

TEST(MeasuredProfile, FirstOrderIsExactForAnIndexMatchedHalfSpace) {
  const double albedo = 0.8;
  const MeasuredProfile m =
      measureProfile({.albedo = Rgb(albedo), .g = 0, .eta = 1, .photons = 400'000, .seed = 5});
  // Integral over cosines of entry (2 mu dmu) and exit (dmu'): albedo / 2 * mu / (mu + mu').
  double first = 0;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double in = (i + 0.5) / kSteps, out = (j + 0.5) / kSteps;
      first += albedo / 2 * 2 * in * out / (in + out) / (kSteps * kSteps);
    }
  EXPECT_NEAR(m.all.total.x - m.fromSecond.total.x, first, 0.01 * first);
}

TEST(MeasuredProfile, OneTableServesEverySize) {
  const Coefficients medium = someMedium();
  const MeasuredProfile rings = measured(medium);
  const auto small = makeTabulated(rings, ProfileOrders::kAll, medium);
  const auto large = makeTabulated(rings, ProfileOrders::kAll, medium.scaled(10));
  for (const double r : {0.001, 0.1, 1.0, 7.0}) {
    EXPECT_NEAR(large->P(10 * r).x, small->P(r).x, 1e-9);
    EXPECT_NEAR(large->Rd(10 * r).x * 100, small->Rd(r).x, 1e-9 * small->Rd(r).x);
  }
}

TEST(MeasuredProfile, ChannelsThatDoNotScatterAreDark) {
  Coefficients medium = someMedium();
  medium.sigma_s.z = 0;
  const auto profile =
      makeTabulated(measureProfile({.albedo = medium.albedo(), .eta = medium.eta, .photons = 20'000}),
                    ProfileOrders::kAll, medium);
  EXPECT_EQ(profile->P(0).z, 0);
  EXPECT_EQ(profile->Rd(0.5).z, 0);
  EXPECT_GT(profile->P(0).x, 0.1);
}

}  // namespace
}  // namespace lychnite
