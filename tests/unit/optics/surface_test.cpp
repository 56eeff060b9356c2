#include "lychnite/optics/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "lychnite/optics/fresnel.h"

namespace lychnite {
namespace {

constexpr double kPi = std::numbers::pi;
const glm::dvec3 kNormal(0, 0, 1);

glm::dvec3 direction(double cosine, double phi) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

/// Reflected share of uniform light from everywhere: the response over the hemisphere of wi, midpoints in the
/// angle and the azimuth, fine enough for roughness 0.3 and up.
double furnace(const SurfaceCoat& coat, double cosO) {
  constexpr int kAngles = 300, kTurns = 200;
  const glm::dvec3 wo = direction(cosO, 0);
  double sum = 0;
  for (int i = 0; i < kAngles; ++i) {
    const double theta = (i + 0.5) * 0.5 * kPi / kAngles;
    double ring = 0;
    for (int j = 0; j < kTurns; ++j)
      ring += surfaceResponse(coat, kNormal, wo, direction(std::cos(theta), (j + 0.5) * kPi / kTurns)).x;
    sum += ring * std::sin(theta);
  }
  return sum * (0.5 * kPi / kAngles) * (2 * kPi / kTurns);
}

TEST(SurfaceCoat, GivesBackNoMoreThanItGets) {
  for (double roughness : {0.3, 0.6, 1.0})
    for (double eta : {1.0, 1.3, 1.5, 4.0})
      for (double cosO : {0.1, 0.5, 0.9}) {
        const SurfaceCoat coat{.eta = eta, .roughness = roughness, .base = Rgb(0)};
        EXPECT_LE(furnace(coat, cosO), 1.0) << roughness << " " << eta << " " << cosO;
        // A smooth coat mirrors by Fresnel's law.
        if (roughness > 0.3 || cosO < 0.4) continue;
        const double mirrored = fresnelReflectance(cosO, eta);
        EXPECT_NEAR(furnace(coat, cosO), mirrored, 0.03 * mirrored + 1e-12) << eta << " " << cosO;
      }
}

TEST(SurfaceCoat, AWhiteBaseAddsWhatTheCoatLetsThrough) {
  // Base alone: Ft(cosO), by the normalisation of the exit lobe. With a rough coat facets steeper than the
  // surface reflect a little more than Fresnel of the surface, which the base does not know: up to 1.2 % too
  // much.
  for (double roughness : {0.3, 1.0})
    for (double cosO : {0.2, 0.6, 1.0}) {
      const double coat = furnace({.eta = 1.3, .roughness = roughness, .base = Rgb(0)}, cosO);
      const double both = furnace({.eta = 1.3, .roughness = roughness, .base = Rgb(1)}, cosO);
      EXPECT_NEAR(both - coat, fresnelTransmittance(cosO, 1.3), 2e-4);
      EXPECT_LE(both, 1.012) << roughness << " " << cosO;
    }
}

TEST(SurfaceCoat, IndexMatchedWhiteIsExactlyLambert) {
  const SurfaceCoat coat{.eta = 1, .roughness = 0.3, .base = Rgb(1)};
  for (double cosI : {0.1, 0.5, 1.0})
    for (double cosO : {0.2, 0.9})
      EXPECT_NEAR(surfaceResponse(coat, kNormal, direction(cosO, 0), direction(cosI, 2)).x, cosI / kPi,
                  1e-14);
}

TEST(SurfaceCoat, IsReciprocal) {
  const SurfaceCoat coat{.eta = 1.4, .roughness = 0.4, .base = {0.2, 0.5, 0.9}};
  for (double a : {0.1, 0.5, 0.95})
    for (double b : {0.2, 0.8})
      for (double phi : {0.0, 1.0, 3.0}) {
        const glm::dvec3 u = direction(a, 0), v = direction(b, phi);
        const Rgb there = surfaceResponse(coat, kNormal, u, v) / b,
                  back = surfaceResponse(coat, kNormal, v, u) / a;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(there[c], back[c], 1e-12 * there[c]);
      }
}

TEST(SurfaceCoat, MirrorDirectionByHand) {
  // wi and wo mirrored at 60 degrees: h = n, D = 1/(pi alpha^2), G2 by Lambda(60 degrees).
  const double cosI = 0.5, roughness = 0.5, alpha = 0.25, eta = 1.5;
  const double lambda = 0.5 * (std::sqrt(1 + alpha * alpha * 3) - 1);
  const double expected =
      fresnelReflectance(cosI, eta) / (kPi * alpha * alpha) / (1 + 2 * lambda) / (4 * cosI * cosI);
  const Rgb value = surfaceResponse({.eta = eta, .roughness = roughness, .base = Rgb(0)}, kNormal,
                                    direction(cosI, 0), direction(cosI, kPi));
  EXPECT_NEAR(value.y, expected * cosI, 1e-12);
}

TEST(SurfaceCoat, NothingFromBehind) {
  const SurfaceCoat coat{.eta = 1.3, .roughness = 0.3, .base = Rgb(1)};
  EXPECT_EQ(surfaceResponse(coat, kNormal, {0, 0, 1}, {0, 0, -1}), Rgb(0));
  EXPECT_EQ(surfaceResponse(coat, kNormal, {0, 0, -1}, {0, 0, 1}), Rgb(0));
  EXPECT_EQ(surfaceResponse(coat, kNormal, {1, 0, 0}, {0, 0, 1}), Rgb(0));
}

}  // namespace
}  // namespace lychnite
