#include "reference/transport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/phase.h"

namespace lychnite {
namespace {

using namespace transport;

TEST(Transport, BoundaryMatchesOptics) {
  for (const double eta : {1.0, 1.3, 1.5, 1 / 1.3, 1 / 1.5})
    for (double cosI = 0.01; cosI <= 1; cosI += 0.01) {
      const Boundary b = fresnel(float(cosI), float(eta));
      EXPECT_NEAR(double(b.reflectance), fresnelReflectance(cosI, eta), 2e-5) << eta << ' ' << cosI;
      const glm::dvec3 d(std::sqrt(1 - cosI * cosI), 0, -cosI), n(0, 0, 1);
      const auto truth = refract(d, n, eta);
      EXPECT_EQ(truth.has_value(), b.reflectance < 1);
      if (!truth) continue;
      const glm::vec3 t = refracted(glm::vec3(d), glm::vec3(n), float(eta), float(cosI), b.cosT);
      EXPECT_LT(glm::length(glm::dvec3(t) - *truth), 1e-5);
    }
}

TEST(Transport, PhaseFunctionMatchesOptics) {
  for (const double g : {-0.9, -0.3, 0.0, 0.0005, 0.01, 0.5, 0.95})
    for (double u = 0.005; u < 1; u += 0.01) {
      const double cosine = sampleHenyeyGreenstein(u, g);
      EXPECT_NEAR(double(henyeyGreensteinCosine(float(1 - u), float(g))), cosine, 5e-4) << g << ' ' << u;
      const double density = lychnite::henyeyGreenstein(cosine, g);
      EXPECT_NEAR(double(transport::henyeyGreenstein(float(cosine), float(g))) / density, 1, 1e-3) << g;
    }
}

TEST(Transport, DeflectionKeepsAngleAndLength) {
  Rng rng(1, 2);
  for (int i = 0; i < 1000; ++i) {
    const glm::vec3 d = scattered({0, 0, 1}, 0, rng);
    const float cosine = 1 - 2 * rng.uniform();
    const glm::vec3 out = deflected(d, cosine, 6.28f * rng.uniform());
    EXPECT_NEAR(glm::dot(d, out), cosine, 1e-5);
    EXPECT_NEAR(glm::length(out), 1, 1e-5);
  }
}

TEST(Transport, ScatteredHasTheMeanCosine) {
  for (const float g : {-0.6f, 0.0f, 0.8f}) {
    Rng rng(3, 4);
    const glm::vec3 d = glm::normalize(glm::vec3(1, 2, -3));
    double sum = 0;
    constexpr int kDraws = 40000;
    for (int i = 0; i < kDraws; ++i) sum += double(glm::dot(scattered(d, g, rng), d));
    EXPECT_NEAR(sum / kDraws, double(g), 4 * 0.58 / std::sqrt(double(kDraws)));  // variance at most 1/3
  }
}

TEST(Transport, StreamsAreRepeatableAndApart) {
  Rng a(5, 6), b(5, 6), c(5, 7), d(6, 6);
  const uint32_t first = a.bits();
  EXPECT_EQ(first, b.bits());
  EXPECT_NE(first, c.bits());
  EXPECT_NE(first, d.bits());
}

TEST(Transport, NumbersFillTheirRange) {
  Rng rng(8, 9);
  double uniform = 0, exponential = 0;
  constexpr int kDraws = 100000;
  for (int i = 0; i < kDraws; ++i) {
    const float u = rng.uniform();
    ASSERT_TRUE(u >= 0 && u < 1);
    ASSERT_LT(rng.below(5), 5u);
    const float e = rng.exponential();
    ASSERT_GE(e, 0);
    uniform += double(u);
    exponential += double(e);
  }
  EXPECT_NEAR(uniform / kDraws, 0.5, 4 * std::sqrt(1 / 12.0 / kDraws));
  EXPECT_NEAR(exponential / kDraws, 1, 4 / std::sqrt(double(kDraws)));
}

/// The weights of flights that collide within L, over the three drawing channels, must be each channel's own
/// chance.
TEST(PathWeight, EveryChannelIsUnbiased) {
  const Medium medium(Coefficients{.sigma_s = Rgb(0.5, 2, 8), .sigma_a = Rgb(0.5, 0, 1), .g = 0, .eta = 1});
  constexpr float kLength = 0.7f;
  constexpr int kDraws = 60000;
  Rng rng(10, 11);
  glm::dvec3 collided(0), passed(0), absorbed(0);
  for (int i = 0; i < kDraws; ++i) {
    PathWeight weight(glm::vec3(1), i % 3);
    const float flight = weight.drawFlight(medium, rng);
    if (flight < kLength) {
      absorbed += glm::dvec3(weight.scatter(medium, flight));
      collided += glm::dvec3(weight.flux());
    } else {
      weight.pass(medium, kLength);
      passed += glm::dvec3(weight.flux());
    }
    ASSERT_LE(weight.largest(), 3.001f);
  }
  for (int c = 0; c < 3; ++c) {
    const double through = std::exp(-double(medium.sigma_t[c]) * double(kLength));
    const double albedo = double(medium.sigma_s[c] / medium.sigma_t[c]);
    const double error = 4 * 1.5 / std::sqrt(double(kDraws));
    EXPECT_NEAR(passed[c] / kDraws, through, error);
    EXPECT_NEAR(collided[c] / kDraws, albedo * (1 - through), error);
    EXPECT_NEAR(absorbed[c] / kDraws, (1 - albedo) * (1 - through), error);
  }
}

TEST(PathWeight, RouletteKeepsTheMean) {
  Rng rng(12, 13);
  double sum = 0;
  constexpr int kDraws = 100000;
  for (int i = 0; i < kDraws; ++i) {
    PathWeight weight(glm::vec3(0.01f), 0);
    if (weight.survives(0.05f, rng)) sum += double(weight.flux().x);
  }
  EXPECT_NEAR(sum / kDraws / 0.01, 1, 4 * 2 / std::sqrt(double(kDraws)));
}

}  // namespace
}  // namespace lychnite
