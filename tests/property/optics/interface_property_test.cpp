#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/phase.h"
#include "lychnite/optics/surface.h"
#include "property/random.h"

namespace lychnite {
namespace {

TEST(InterfaceProperties, FresnelIsAShareAndTheSameBothWays) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const double eta = random.logUniform(0.25, 4), c = random.uniform(0, 1);
    const double R = fresnelReflectance(c, eta);
    ASSERT_GE(R, 0) << c << " " << eta;
    ASSERT_LE(R, 1) << c << " " << eta;
    const double sin2T = (1 - c * c) / (eta * eta);
    if (sin2T < 1) {
      ASSERT_NEAR(fresnelReflectance(std::sqrt(1 - sin2T), 1 / eta), R, 1e-9) << c << " " << eta;
    }
  }
}

TEST(InterfaceProperties, RefractionCanBeTurnedBack) {
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const glm::dvec3 n = random.direction();
    glm::dvec3 d = random.direction();
    if (glm::dot(d, n) > 0) d = -d;
    if (glm::dot(d, n) > -0.01) continue;
    const double eta = random.uniform(1, 4);
    const auto in = refract(d, n, eta);
    ASSERT_TRUE(in);
    const auto out = refract(-*in, -n, 1 / eta);
    ASSERT_TRUE(out);
    ASSERT_NEAR(glm::distance(*out, -d), 0, 1e-9);
  }
}

TEST(InterfaceProperties, ExitLobeIntegratesToOne) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const double eta = random.uniform(1, 4);
    double sum = 0;
    constexpr int kSteps = 2000;
    for (int j = 0; j < kSteps; ++j) {
      const double t = (j + 0.5) / kSteps;
      sum += exitLobe(t * t, eta) * 2 * t * t * t;  // mu = t^2
    }
    ASSERT_NEAR(sum / kSteps * 6.283185307179586, 1, 1e-5) << eta;
  }
}

TEST(InterfaceProperties, PhaseSamplesFollowTheDensity) {
  Random random(4);
  for (int i = 0; i < 30; ++i) {
    const double g = random.uniform(-0.9, 0.9);
    // Ten bins of cosTheta: counts of random samples against the integral, within five standard deviations.
    constexpr int kSamples = 20000, kBins = 10;
    int counts[kBins] = {};
    for (int j = 0; j < kSamples; ++j) {
      const double c = sampleHenyeyGreenstein(random.uniform(0, 1), g);
      ++counts[std::min(kBins - 1, int((c + 1) * 0.5 * kBins))];
    }
    for (int b = 0; b < kBins; ++b) {
      double share = 0;
      for (int j = 0; j < 1000; ++j) share += henyeyGreenstein(-1 + 2 * (b + (j + 0.5) / 1000) / kBins, g);
      share *= 6.283185307179586 * 2 / kBins / 1000;
      EXPECT_NEAR(counts[b], share * kSamples, 5 * std::sqrt(share * kSamples) + 1) << g << " bin " << b;
    }
  }
}

TEST(InterfaceProperties, CoatsAreReciprocalAndNotNegative) {
  Random random(5);
  for (int i = 0; i < 5000; ++i) {
    const SurfaceCoat coat{
        .eta = random.uniform(1, 4), .roughness = random.uniform(0.02, 1), .base = random.rgb(0, 1)};
    const glm::dvec3 n = random.direction(), u = random.direction(), v = random.direction();
    const double cu = glm::dot(n, u), cv = glm::dot(n, v);
    const Rgb there = surfaceResponse(coat, n, u, v), back = surfaceResponse(coat, n, v, u);
    if (cu <= 0 || cv <= 0) {
      ASSERT_EQ(there, Rgb(0));
      continue;
    }
    for (int c = 0; c < 3; ++c) {
      ASSERT_GE(there[c], 0);
      ASSERT_NEAR(there[c] * cu, back[c] * cv, 1e-9 * there[c] * cu + 1e-15);
    }
  }
}

}  // namespace
}  // namespace lychnite
