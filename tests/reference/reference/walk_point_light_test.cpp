// The walk's point lights against answers that the walk had no part in.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "lychnite/mesh/builtin.h"
#include "lychnite/reference/reference.h"
#include "lychnite/reference/slab.h"
#include "reference/reference/walk_scenes.h"

namespace lychnite {
namespace {

/// Mean of a layer ("radiosity" or "single") of a picture, and its error.
std::pair<Rgb, Rgb> meanOf(const Scene& scene, const std::string& layer, double photons) {
  return overSeeds(5, [&](uint64_t seed) {
    RenderSettings settings = walkSettings(24, photons);
    settings.components = {.multiple = false, .single = layer == "single", .surface = false};
    settings.aovs = {layer};
    settings.seed = seed;
    return middle(renderReference(scene, settings), layer);
  });
}

TEST(WalkPointLight, FarAwayIsParallel) {
  const Coefficients medium{.sigma_s = Rgb(1, 2, 3), .sigma_a = Rgb(0.05, 0.1, 0.3), .g = 0.2, .eta = 1.3};
  Scene parallel = sceneOf(translucent(builtinMesh("stone"), 12, medium));
  parallel.lights = {ParallelLight{.azimuth = 70, .elevation = 30, .irradiance = Rgb(2)}};
  Scene point = parallel;
  constexpr double kFar = 20'000;
  point.lights = {
      PointLight{.position = kFar * directionFromAngles(70, 30), .intensity = Rgb(2 * kFar * kFar)}};
  for (const std::string layer : {"radiosity", "single"}) {
    const auto [a, aError] = meanOf(parallel, layer, 30);
    const auto [b, bError] = meanOf(point, layer, 30);
    for (int c = 0; c < 3; ++c) {
      const double error = std::hypot(aError[c], bError[c]);
      EXPECT_NEAR(b[c], a[c], kSigmas * error + 0.001 * a[c]) << layer << " " << c;
      EXPECT_LT(error, 0.03 * a[c]);
    }
  }
}

/// Above a medium so dense that light leaves where it enters, a point light at height h makes, at the
/// distance x from the point below it, I cos / (h^2 + x^2) times what a half-space sends back at that
/// incidence.
TEST(WalkPointLight, InverseSquareCosineAndFresnelOverADenseBox) {
  const Coefficients medium{.sigma_s = Rgb(60), .sigma_a = Rgb(4), .g = 0, .eta = 1.4};
  constexpr double kHeight = 5, kTop = 2;
  for (const double x : {0.0, 5.0}) {
    Scene scene = sceneOf(translucent(boxMesh(glm::vec3(2, 2, kTop)), 4, medium));
    scene.lights = {PointLight{.position = {x, 0, kTop + kHeight}, .intensity = Rgb(100)}};
    scene.camera = PinholeCamera{.position = {0, 0, kTop + 200}, .target = {0, 0, 0}, .fov = 0.25};
    const auto [mean, error] = meanOf(scene, "radiosity", 150);
    SlabSettings slab{.medium = medium,
                      .incidenceDegrees = std::atan2(x, kHeight) * 180 / std::numbers::pi,
                      .photons = 400'000,
                      .ringEdges = {}};
    const SlabResult sent = simulateSlab(slab);
    const double squared = kHeight * kHeight + x * x;
    const double expected = 100 * kHeight / std::pow(squared, 1.5) * sent.diffuse_reflectance.value.x;
    EXPECT_NEAR(mean.x / expected, 1, kSigmas * error.x / expected + 0.01) << x;
    EXPECT_LT(error.x / expected, 0.025) << x;
  }
}

TEST(WalkPointLight, NothingAbsorbedAllComesOutOfALamp) {
  const Coefficients medium{.sigma_s = Rgb(2), .sigma_a = Rgb(0), .g = 0.5, .eta = 1.5};
  Scene scene = sceneOf(translucent(builtinMesh("knot"), 20, medium));
  scene.lights = {PointLight{.position = {6, 1, 3}, .intensity = Rgb(10)},
                  PointLight{.position = {-20, 0, 0}, .intensity = Rgb(100)}};
  const Image image = renderReference(scene, walkSettings(24, 20));
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(share(image, "escaped")[c] + share(image, "lost")[c] + share(image, "ended")[c], 1, 2e-5);
  EXPECT_LT(share(image, "lost").x, 1e-3);
}

/// Twice the size in a medium half as dense under a lamp four times as strong, twice as far: the same
/// picture.
TEST(WalkPointLight, ScalesWithTheWorld) {
  const Coefficients medium{.sigma_s = Rgb(2), .sigma_a = Rgb(0.1), .g = 0, .eta = 1.3};
  Scene small = sceneOf(translucent(builtinMesh("sphere"), 6, medium));
  small.lights = {PointLight{.position = {3, 4, 5}, .intensity = Rgb(50)}};
  Scene large = sceneOf(translucent(builtinMesh("sphere"), 12, medium.scaled(2)));
  large.lights = {PointLight{.position = {6, 8, 10}, .intensity = Rgb(200)}};
  const Image a = renderReference(small, walkSettings(16, 20)),
              b = renderReference(large, walkSettings(16, 20));
  EXPECT_NEAR(middle(b, "").x, middle(a, "").x, 1e-4 * middle(a, "").x);
}

}  // namespace
}  // namespace lychnite
