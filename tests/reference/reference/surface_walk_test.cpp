#include "lychnite/reference/surface_walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "lychnite/base/error.h"
#include "lychnite/mesh/builtin.h"
#include "lychnite/optics/materials.h"
#include "lychnite/reference/reference.h"
#include "lychnite/reference/slab.h"
#include "plain_walk.h"
#include "reference/surface_samples.h"
#include "walk_scenes.h"

namespace lychnite {
namespace {

Rgb meanOf(const std::vector<Rgb>& values) {
  return std::accumulate(values.begin(), values.end(), Rgb(0)) / double(values.size());
}

Scene sceneOf(const char* model, const char* material, double size) {
  return sceneOf(translucent(builtinMesh(model), size, findMaterial(material, "").coefficients));
}

TEST(SurfacePatches, EveryPointOfAPatchIsFoundInIt) {
  for (const char* model : {"slab", "figurine"}) {  // 2 triangles a wall, and 31 thousand
    const RayScene rays(sceneOf(model, "fig6", 10));
    const SurfaceSampler sampler(rays.mesh(0));
    constexpr size_t kPatches = 700, kEach = 5;
    const auto points = sampler.pointsOfPatches(kPatches, kEach, 3);
    ASSERT_EQ(points.size(), kPatches * kEach);
    size_t elsewhere = 0;  // float weights of a point on the border of two patches may tell the other one
    for (size_t i = 0; i < points.size(); ++i) elsewhere += sampler.patchOf(points[i], kPatches) != i / kEach;
    EXPECT_LT(elsewhere, points.size() / 1000) << model;
  }
}

TEST(SurfaceWalk, LeavesAllLightWhereNothingIsAbsorbed) {
  Coefficients medium;
  medium.sigma_s = Rgb(1, 2, 4);
  medium.eta = 1;  // nothing is mirrored
  Scene scene = sceneOf(translucent(builtinMesh("sphere"), 20, medium));
  const SurfaceWalkResult walk = surfaceWalk(scene, {.patches = 1, .photons = 200'000});
  // Of a sphere's cross section, less what passes unscattered: int 2 r exp(-2 sigma R sqrt(1 - r^2)) dr.
  for (int c = 0; c < 3; ++c) {
    const double t = 20 * medium.sigma_s[c], passes = 2 * (1 - (1 + t) * std::exp(-t)) / (t * t);
    const double expected = ParallelLight{}.irradiance[c] / 4 * (1 - passes);
    const double mean = 0.5 * (walk.radiosity[0][0][0][c] + walk.radiosity[1][0][0][c]);
    EXPECT_NEAR(mean, expected, 0.004 * expected) << c;  // the mesh is inscribed: .2 % of the area
  }
}

TEST(SurfaceWalk, ReflectsAndTransmitsLikeASlab) {
  const Coefficients medium = findMaterial("skin1", "").coefficients;
  Scene scene = sceneOf("slab", "skin1", 20);  // 2 mm thick, some three mean free paths
  scene.lights = {ParallelLight{.azimuth = 0, .elevation = 0, .irradiance = Rgb(1)}};
  constexpr size_t kPatches = 4000;
  const SurfaceWalkResult walk = surfaceWalk(scene, {.patches = kPatches, .photons = 600'000});
  const SlabResult slab = simulateSlab({.medium = medium, .thickness = 2, .photons = 400'000});
  const auto points = patchPoints(scene, 0, kPatches, 1);
  const Mesh& mesh = *scene.objects[0].mesh;
  Rgb reflected(0), transmitted(0);
  double top = 0, bottom = 0;
  for (size_t i = 0; i < kPatches; ++i) {
    const glm::uvec3& t = mesh.triangles[points[i].triangle];
    const glm::vec3 p = (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f;
    if (std::abs(p.x) > 0.25f || std::abs(p.y) > 0.25f) continue;
    const Rgb both = 0.5 * (walk.radiosity[0][0][i] + walk.radiosity[1][0][i]);
    (p.z > 0 ? reflected : transmitted) += both;
    (p.z > 0 ? top : bottom) += 1;
  }
  for (int c = 0; c < 3; ++c) {
    const double R = slab.diffuse_reflectance.value[c],
                 T = slab.total_transmittance.value[c] - slab.unscattered_transmittance.value[c];
    EXPECT_NEAR(reflected[c] / top, R, 0.02 * R + 0.02 * slab.unscattered_transmittance.value[c]) << c;
    EXPECT_NEAR(transmitted[c] / bottom, T, 0.03 * T) << c;
  }
}

TEST(SurfaceWalk, AgreesWithTheWalkThatACameraSees) {
  Scene scene = sceneOf("sphere", "skin1", 20);
  // The camera stands where the light comes from, far away: it sees what half of the patches are.
  scene.lights = {ParallelLight{.azimuth = 0, .elevation = 0}};
  scene.camera = OrbitCamera{.azimuth = 0, .elevation = 0, .fov = 2};
  RenderSettings settings = walkSettings(16, 400);
  settings.aovs = {"radiosity"};
  const Image picture = renderReference(scene, settings);
  constexpr size_t kPatches = 4000;
  const SurfaceWalkResult walk = surfaceWalk(scene, {.patches = kPatches, .photons = 600'000});
  const auto points = patchPoints(scene, 0, kPatches, 1);
  const Mesh& mesh = *scene.objects[0].mesh;
  Rgb seen(0), pictured(0);
  for (size_t i = 0; i < kPatches; ++i) {
    const float z = mesh.positions[mesh.triangles[points[i].triangle].x].z;
    // A patch covers a part of the picture that goes with its cosine.
    if (z > 0) seen += double(z) * 0.5 * (walk.radiosity[0][0][i] + walk.radiosity[1][0][i]);
  }
  double cosines = 0, pixels = 0;
  for (size_t i = 0; i < kPatches; ++i)
    cosines += std::max(0.0, double(mesh.positions[mesh.triangles[points[i].triangle].x].z));
  for (size_t i = 0; i < picture.pixelCount(); ++i) {
    pictured += Rgb(picture.rgb(i, "radiosity"));
    pixels += double(picture.channel("A")[i]);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c] / cosines, pictured[c] / pixels, 0.02 * seen[c] / cosines);
}

/// On a shape with hollows, where light leaves and enters again, of channels that differ and scatter
/// forwards.
TEST(SurfaceWalk, AgreesPatchByPatchWithAWalkWithoutArt) {
  const Coefficients medium{.sigma_s = Rgb(0.6, 2, 3), .sigma_a = Rgb(0.05, 0.02, 0.6), .g = 0.5, .eta = 1.4};
  const Scene scene = sceneOf(translucent(builtinMesh("figurine"), 6, medium));
  constexpr size_t kPatches = 60;
  const SurfaceWalkResult walk = surfaceWalk(scene, {.patches = kPatches, .photons = 300'000});
  const RayScene rays(scene);
  for (int c = 0; c < 3; ++c) {
    const auto plain = PlainWalk(rays, c, kPatches, unsigned(c) + 1).radiosity(600'000);
    double squares = 0, variance = 0, told = 0, sum = 0;
    for (size_t p = 0; p < kPatches; ++p) {
      const double t[2] = {walk.radiosity[0][0][p][c], walk.radiosity[1][0][p][c]};
      const double a = plain[0][p] - t[0], b = plain[1][p] - t[1];
      squares += a * b;
      // With a and b of variance s^2 the product's is s^4 where nothing is wrong, and (a - b)^4 is 12 s^4.
      variance += std::pow(a - b, 4) / 12;
      told += 0.5 * (t[0] + t[1]);
      sum += 0.5 * (plain[0][p] + plain[1][p]);
    }
    const double mean = told / kPatches;
    EXPECT_NEAR(sum / told, 1, 0.015) << c;
    EXPECT_LT(squares, kSigmas * std::sqrt(variance)) << c;
    // What a relative error of 5 % of every patch would make, it can tell.
    EXPECT_LT(kSigmas * std::sqrt(variance), kPatches * std::pow(0.05 * mean, 2)) << c;
  }
}

TEST(SurfaceWalk, IsTheSameOnAnyThreadsAndItsHalvesDiffer) {
  const Scene scene = sceneOf("figurine", "fig6", 10);
  const SurfaceWalkResult one = surfaceWalk(scene, {.patches = 50, .photons = 30'000, .threads = 1});
  const SurfaceWalkResult two = surfaceWalk(scene, {.patches = 50, .photons = 30'000, .threads = 2});
  for (size_t half : {0, 1}) EXPECT_EQ(one.radiosity[half], two.radiosity[half]);
  EXPECT_NE(one.radiosity[0], one.radiosity[1]);
  const Rgb a = meanOf(one.radiosity[0][0]), b = meanOf(one.radiosity[1][0]);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 0.05 * a[c]);
}

TEST(SurfaceWalk, NoiseFallsWithTheRootOfThePhotonsAndStopsIt) {
  const Scene scene = sceneOf("sphere", "fig6", 10);
  double squares[2] = {0, 0};
  for (uint64_t seed = 1; seed <= 3; ++seed)
    for (const int times : {1, 4}) {
      const double noise =
          surfaceWalk(scene, {.patches = 300, .photons = 24576.0 * times, .seed = seed}).noise;
      squares[times / 4] += noise * noise;
    }
  EXPECT_NEAR(squares[0] / squares[1], 4, 0.8);  // 900 values each: good to some 8 % of a ratio
  const double wished = 0.7 * std::sqrt(squares[1] / 3);
  const SurfaceWalkResult walk = surfaceWalk(scene, {.patches = 300, .photons = 1, .noise = wished});
  EXPECT_LE(walk.noise, wished);
  EXPECT_GT(walk.noise, 0.7 * wished);
}

TEST(SurfaceWalk, RefusesNumbersOutOfRange) {
  const Scene scene = sceneOf("sphere", "fig6", 10);
  EXPECT_THROW(surfaceWalk(scene, {.patches = 0}), Error);
  EXPECT_THROW(surfaceWalk(scene, {.photons = 0}), Error);
  EXPECT_THROW(surfaceWalk(scene, {.timeLimit = -1}), Error);
  EXPECT_THROW(surfaceWalk(scene, {.noise = -1}), Error);
}

}  // namespace
}  // namespace lychnite
