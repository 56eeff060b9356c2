#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "lychnite/base/error.h"
#include "lychnite/optics/fresnel.h"
#include "lychnite/reference/reference.h"
#include "reference/reference/dipole_scenes.h"

namespace lychnite {
namespace {

using test::litScene;
using test::picture;

DiffusionSum sumOf(const Scene& scene, const RenderSettings& settings) {
  const RayScene rays(scene);
  return sumDipole(rays, findReceivers(rays, settings.width, settings.height), settings);
}

/// The receiver nearest to the picture's middle.
size_t middle(const CameraReceivers& receivers) {
  size_t best = 0;
  double least = 1e30;
  for (size_t i = 0; i < receivers.receivers.size(); ++i) {
    const uint32_t pixel = receivers.receivers[i].pixel, width = uint32_t(receivers.width);
    const double x = pixel % width + 0.5 - 0.5 * width, y = pixel / width + 0.5 - 0.5 * receivers.height;
    if (x * x + y * y < least) {
      least = x * x + y * y;
      best = i;
    }
  }
  return best;
}

struct DiscCase {
  ProfileKind profile;
  const char* material;
  double size;
};

class Disc : public testing::TestWithParam<DiscCase> {};

TEST_P(Disc, CentreGivesBackTheHalfSpaceTotal) {
  const DiscCase& how = GetParam();
  Scene scene;
  scene.objects = {test::object(builtinMesh("disc"), how.material, how.size)};
  scene.lights = {ParallelLight{.azimuth = 0, .elevation = 0, .irradiance = {3, 2, 1}}};
  scene.camera = OrbitCamera{.azimuth = 0, .elevation = 10, .factor = 1, .fov = 30};
  RenderSettings settings = picture(12, 0.002);
  settings.profile = how.profile;
  const RayScene rays(scene);
  const CameraReceivers receivers = findReceivers(rays, 12, 12);
  const DiffusionSum sum = sumDipole(rays, receivers, settings);
  const Coefficients medium = scene.objects[0].material.medium;
  // The light that a disc of this radius loses at its edge is gone from the expectation too.
  const auto profile = makeProfile(how.profile, medium);
  const Rgb total = profile->P(0) - profile->P(0.5 * how.size);
  const Rgb expected = total * fresnelTransmittance(1, medium.eta) * Rgb(3, 2, 1);
  const glm::vec3 found = sum.radiosity[middle(receivers)];
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1.0, 0.005) << c;
}

INSTANTIATE_TEST_SUITE_P(Sizes, Disc,
                         testing::Values(DiscCase{ProfileKind::kDipole, "fig6", 20},
                                         DiscCase{ProfileKind::kDipole, "marble", 300},
                                         DiscCase{ProfileKind::kDipole, "skin1", 10000},
                                         DiscCase{ProfileKind::kBetterDipole, "skimmilk", 100},
                                         DiscCase{ProfileKind::kNormalizedDiffusion, "skin1", 30},
                                         DiscCase{ProfileKind::kNormalizedDiffusion, "marble", 1000}));

/// The dipole integral over a unit sphere lit along `light`, at `x`, by quadrature. About x, area is r dr
/// dphi exactly, r the straight distance.
Rgb sphereRadiosity(const Profile& profile, double eta, const glm::dvec3& light, const glm::dvec3& x) {
  const glm::dvec3 t =
      glm::normalize(glm::cross(x, std::abs(x.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
  const glm::dvec3 s = glm::cross(x, t);
  constexpr int kRadii = 400, kAngles = 256;
  Rgb sum(0);
  for (int i = 0; i < kRadii; ++i) {
    // r = 2 u^3: dense at the peak.
    const double u = (i + 0.5) / kRadii, r = 2 * u * u * u, dr = 6 * u * u / kRadii;
    const double height = 1 - 0.5 * r * r, across = r * std::sqrt(1 - 0.25 * r * r);
    double entering = 0;
    for (int j = 0; j < kAngles; ++j) {
      const double phi = 2 * std::numbers::pi * (j + 0.5) / kAngles;
      const double cosI = glm::dot(light, height * x + across * (std::cos(phi) * t + std::sin(phi) * s));
      if (cosI > 0) entering += fresnelTransmittance(cosI, eta) * cosI;
    }
    sum += profile.Rd(r) * (r * dr * entering * 2 * std::numbers::pi / kAngles);
  }
  return sum;
}

class SphereSizes : public testing::TestWithParam<double> {};

TEST_P(SphereSizes, AgreesWithQuadrature) {
  Scene scene;
  scene.objects = {test::object(test::fineSphere(192), "fig6", GetParam())};
  scene.lights = {ParallelLight{.azimuth = 100, .elevation = 20, .irradiance = Rgb(1)}};
  const RayScene rays(scene);
  const CameraReceivers receivers = findReceivers(rays, 16, 16);
  const DiffusionSum sum = sumDipole(rays, receivers, picture(16, 0.003));
  const auto profile = makeDipole(rays.medium(0));
  const glm::dvec3 light = directionFromAngles(100, 20);
  DiffusionSum expected = sum;
  for (size_t i = 0; i < sum.radiosity.size(); ++i) {
    const glm::dvec3 x = glm::normalize(glm::dvec3(receivers.receivers[i].hit.position));
    expected.radiosity[i] = glm::vec3(sphereRadiosity(*profile, rays.medium(0).eta, light, x));
  }
  EXPECT_LT(sum.error, 0.003);
  // The flat facets of the sphere are worth about as much as the noise.
  EXPECT_LT(test::relativeError(sum, expected, receivers), 0.008);
}

INSTANTIATE_TEST_SUITE_P(Sizes, SphereSizes, testing::Values(0.1, 3.0, 30.0, 300.0));

TEST(Dipole, ScalesWithTheWorld) {
  const Scene small = litScene("knot", "marble", 8, 120);
  Scene large = small;
  large.objects[0].size *= 50;
  large.objects[0].material.medium = large.objects[0].material.medium.scaled(50);
  const DiffusionSum a = sumOf(small, picture(24)), b = sumOf(large, picture(24));
  ASSERT_EQ(a.radiosity.size(), b.radiosity.size());
  for (size_t i = 0; i < a.radiosity.size(); ++i)
    EXPECT_LT(glm::distance(a.radiosity[i], b.radiosity[i]), 1e-3f * glm::length(a.radiosity[i]) + 1e-6f);
}

TEST(Dipole, ItsErrorEstimateIsHonest) {
  for (double size : {10.0, 100.0}) {
    const RayScene rays(litScene("knot", "skin2", size, 150));
    const CameraReceivers receivers = findReceivers(rays, 28, 28);
    const DiffusionSum rough = sumDipole(rays, receivers, picture(28, 0.02));
    RenderSettings fine = picture(28, 0.3 * rough.error);
    fine.seed = 99;
    const DiffusionSum truth = sumDipole(rays, receivers, fine);
    const double found = test::relativeError(rough, truth, receivers);
    EXPECT_LE(rough.error, 0.02) << size;
    EXPECT_GT(found, 0.3 * rough.error) << size;
    EXPECT_LT(found, 2.5 * rough.error) << size;
  }
}

TEST(Dipole, TwoLightsAreTheSum) {
  Scene scene = litScene("stone", "skimmilk", 20, 30);
  scene.lights.push_back(PointLight{.position = {-40, 10, 5}, .intensity = {500, 800, 200}});
  const RayScene rays(scene);
  const CameraReceivers receivers = findReceivers(rays, 24, 24);
  const RenderSettings settings = picture(24, 0.003);
  const DiffusionSum both = sumDipole(rays, receivers, settings);
  DiffusionSum added = sumDipole(rays, receivers, settings, {.light = 0});
  const DiffusionSum second = sumDipole(rays, receivers, settings, {.light = 1});
  for (size_t i = 0; i < added.radiosity.size(); ++i) added.radiosity[i] += second.radiosity[i];
  EXPECT_LT(test::relativeError(both, added, receivers), 0.006);
  EXPECT_GT(test::relativeError(both, second, receivers), 0.1);
}

TEST(Dipole, PointLightFallsWithTheSquareOfTheDistance) {
  // A small stone seen by a far point light is a stone in parallel light of I / d^2.
  Scene point = litScene("stone", "marble", 2, 0);
  point.lights = {PointLight{.position = {0, 0, 4000}, .intensity = Rgb(16e6)}};
  Scene parallel = point;
  parallel.lights = {ParallelLight{.azimuth = 0, .elevation = 0, .irradiance = Rgb(1)}};
  const RayScene a(point), b(parallel);
  const CameraReceivers receivers = findReceivers(a, 16, 16);
  const RenderSettings settings = picture(16, 0.003);
  EXPECT_LT(
      test::relativeError(sumDipole(a, receivers, settings), sumDipole(b, receivers, settings), receivers),
      0.004);
}

TEST(Dipole, AnObjectInFrontOfTheLightShadows) {
  Scene open = litScene("sphere", "skin1", 10, 0);
  open.lights = {ParallelLight{.azimuth = 0, .elevation = 0}};
  open.camera = PinholeCamera{.position = {40, 0, 0}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fov = 20};
  Scene shaded = open;
  Object wall = test::object(builtinMesh("sphere"), "marble", 20);
  wall.material.opaque = true;
  wall.position = {0, 0, 60};
  shaded.objects.push_back(wall);
  const DiffusionSum lit = sumOf(open, picture(16)), dark = sumOf(shaded, picture(16));
  double open_sum = 0, dark_sum = 0;
  for (const glm::vec3& b : lit.radiosity) open_sum += b.x;
  for (const glm::vec3& b : dark.radiosity) dark_sum += b.x;
  EXPECT_GT(open_sum, 1);
  EXPECT_EQ(dark_sum, 0);
}

TEST(Dipole, EachObjectKeepsItsOwnLight) {
  // Light that enters one object leaves it, not the one beside.
  Scene scene = litScene("sphere", "marble", 5, 90);
  scene.lights = {ParallelLight{.azimuth = 90, .elevation = 0}};
  Object second = scene.objects[0];
  second.position = {-6, 0, 0};  // behind the first, in its shadow
  second.size = 4;
  scene.objects.push_back(second);
  const RayScene rays(scene);
  const CameraReceivers receivers = findReceivers(rays, 24, 24);
  const DiffusionSum sum = sumDipole(rays, receivers, picture(24));
  double first = 0, behind = 0;
  for (size_t i = 0; i < sum.radiosity.size(); ++i)
    (receivers.receivers[i].hit.object == 0 ? first : behind) += sum.radiosity[i].y;
  EXPECT_GT(first, 1);
  EXPECT_EQ(behind, 0);
}

TEST(Dipole, NoLightOrNoScatteringIsDark) {
  Scene unlit = litScene("stone", "marble", 20, 40);
  unlit.lights.clear();
  Scene clear = litScene("stone", "marble", 20, 40);
  clear.objects[0].material.medium.sigma_s = Rgb(0);
  for (const Scene& scene : {unlit, clear})
    for (const glm::vec3& b : sumOf(scene, picture(12)).radiosity) EXPECT_EQ(b, glm::vec3(0));
}

TEST(Dipole, StopsWhenInterrupted) {
  int calls = 0;
  const Progress progress([&](const Progress::Update&) { return ++calls < 3; });
  EXPECT_THROW(renderReference(litScene("stone", "marble", 20, 40), picture(32), progress), Interrupted);
  EXPECT_EQ(calls, 3);
}

TEST(Dipole, WarnsOnlyWhenItStopsAboveItsTolerance) {
  const Scene scene = litScene("stone", "marble", 20, 40);
  for (const double tolerance : {1e-5, 0.02}) {
    RenderSettings settings = picture(3, tolerance);
    settings.components = {.multiple = true, .single = false, .surface = false};
    int warnings = 0;
    const Image image = renderReference(scene, settings, {}, [&](LogLevel level, std::string_view) {
      warnings += level == LogLevel::kWarning;
    });
    const bool above = std::stod(image.metadata.at("estimated_error")) > tolerance;
    EXPECT_EQ(warnings, above ? 1 : 0);
    EXPECT_EQ(above, tolerance < 1e-3);
  }
}

TEST(Dipole, PictureRecordsHowItWasMade) {
  RenderSettings settings = picture(20);
  settings.components = {.multiple = true, .single = false, .surface = false};
  settings.aovs = {"radiosity", "depth"};
  const Image image = renderReference(litScene("stone", "marble", 20, 40), settings);
  EXPECT_LE(std::stod(image.metadata.at("estimated_error")), settings.tolerance);
  EXPECT_GT(std::stod(image.metadata.at("surface_samples")), 1000);
  EXPECT_TRUE(image.hasRgb("radiosity"));
  // The middle of the stone faces the camera: L = B S_w(about 1).
  const size_t i = 10 * 20 + 10;
  EXPECT_NEAR(image.rgb(i).y / image.rgb(i, "radiosity").y, exitLobe(0.95, 1.5), 0.1 * exitLobe(1, 1.5));
}

}  // namespace
}  // namespace lychnite
