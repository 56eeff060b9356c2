#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "reference/dipole_kernel.h"
#include "reference/dipole_near_field.h"
#include "reference/dipole_shells.h"
#include "reference/octree.h"
#include "reference/reference/dipole_scenes.h"
#include "reference/surface_samples.h"

namespace lychnite {
namespace {

/// Sources strewn over the unit ball along no curve.
FluxPoints strewn(size_t n) {
  FluxPoints points;
  for (size_t i = 0; i < n; ++i) {
    const auto u = [&](uint64_t axis) { return float(uniformAt(axis, i) * 2 - 1); };
    points.add({u(1), u(2), u(3)}, {1 + u(4), 1 + u(5), 1 + u(6)});
  }
  return points;
}

TEST(KernelTable, FollowsTheProfileThroughEveryShell) {
  const auto profile = makeDipole(findMaterial("fig6", "").coefficients.scaled(0.2));  // units of 5 mm
  const double radius[] = {0, 0.1, 0.4};
  for (double d = 1e-4; d < 2; d *= 1.1) {
    Rgb sum(0);
    for (int shell = 0; shell < 3; ++shell) {
      const KernelTable table(*profile, radius[shell], shell < 2 ? radius[shell + 1] : 0, 3);
      FluxPoints one;
      one.add({0, float(d), 0}, {1, 1, 1});
      sum += sumKernel(table, {0, 0, 0}, one, 0, 1);
    }
    const Rgb expected = profile->Rd(float(d));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / expected[c], 1, 1e-3) << d;
  }
}

TEST(SumKernel, IsTheSumWhateverTheRange) {
  const auto profile = makeDipole(findMaterial("marble", "").coefficients.scaled(0.1));
  const KernelTable table(*profile, 0, 0, 6);
  const FluxPoints points = strewn(5003);
  const glm::vec3 o(0.2f, -0.1f, 0.4f);
  for (const auto& [begin, end] : {std::pair<size_t, size_t>{0, 5003}, {17, 30}, {5, 5}, {100, 4999}}) {
    Rgb expected(0);
    for (size_t i = begin; i < end; ++i) {
      const double r = glm::distance(glm::dvec3(points.x[i], points.y[i], points.z[i]), glm::dvec3(o));
      expected += profile->Rd(r) * Rgb(points.flux[0][i], points.flux[1][i], points.flux[2][i]);
    }
    const Rgb found = sumKernel(table, o, points, begin, end);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 3e-4 * expected[c]);
  }
}

TEST(SurfaceSampler, SpreadsEvenlyOverTriangles) {
  Scene scene = test::litScene("knot", "marble", 10, 0);
  const RayScene rays(scene);
  const SurfaceSampler sampler(rays.mesh(0));
  double area = 0, moment = 0;
  const RayMesh& mesh = rays.mesh(0);
  for (const glm::uvec3& t : *mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const double part = 0.5 * glm::length(glm::cross(b - a, c - a));
    area += part;
    // Exact second moment of x over a triangle.
    moment += part / 6 * (a.x * a.x + b.x * b.x + c.x * c.x + a.x * b.x + b.x * c.x + c.x * a.x);
  }
  EXPECT_NEAR(sampler.area(), area, 1e-6 * area);
  double sampled = 0;
  const auto points = sampler.sample(20000, 3);
  for (const SurfacePoint& p : points)
    sampled += double(p.position.x) * p.position.x * area / double(points.size());
  // Free points would be off by 0.6 %; evenly spread ones by far less.
  EXPECT_NEAR(sampled / moment, 1, 5e-4);
  for (const SurfacePoint& p : points) ASSERT_NEAR(glm::length(p.normal), 1, 1e-5);
}

TEST(Thinned, KeepsEveryKernelsSumOnAverage) {
  const FluxPoints points = strewn(2000);
  double all = 0, mean = 0;
  const auto weigh = [](const FluxPoints& list) {
    double sum = 0;
    for (size_t i = 0; i < list.size(); ++i) sum += list.flux[1][i] * std::exp(-2 * list.x[i]);
    return sum;
  };
  all = weigh(points);
  constexpr int kRounds = 400;
  for (int i = 0; i < kRounds; ++i) mean += weigh(thinned(points, 16, uint64_t(i))) / kRounds;
  EXPECT_EQ(thinned(points, 16, 1).size(), 125u);
  EXPECT_NEAR(mean / all, 1, 0.02);
}

TEST(FluxOctree, StandsForAllItsSources) {
  const RayScene rays(test::litScene("stone", "marble", 10, 30));
  const SurfaceSampler sampler(rays.mesh(0));
  const FluxPoints sources = litSamples(rays, 0, sampler, 30000, 1, -1);
  const FluxOctree tree(sources, sampler.area() / 30000);
  Box box;
  const glm::vec3 somewhere(sources.x[2000], sources.y[2000], sources.z[2000]);
  box.add(somewhere);
  box.add(somewhere + glm::vec3(0.05f, -0.05f, 0.02f));
  const auto flux = [](const FluxPoints& list) {
    double sum = 0;
    for (float f : list.flux[2]) sum += f;
    return sum;
  };
  FluxPoints coarse, exact, near;
  tree.gather(box, 0.1f, coarse);
  tree.gather(box, 0, exact);
  tree.gatherNear(box, 0.3f, near);
  EXPECT_EQ(exact.size(), sources.size());
  EXPECT_LT(coarse.size(), sources.size() / 5);
  EXPECT_NEAR(flux(coarse) / flux(sources), 1, 1e-4);
  const auto profile = makeDipole(rays.medium(0));
  const KernelTable table(*profile, 0, 0, 4);
  const Rgb a = sumKernel(table, box.centre(), coarse, 0, coarse.size());
  const Rgb b = sumKernel(table, box.centre(), sources, 0, sources.size());
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / b[c], 1, 3e-3);
  size_t within = 0, found = 0;
  for (size_t i = 0; i < sources.size(); ++i)
    within += glm::distance(glm::vec3(sources.x[i], sources.y[i], sources.z[i]), box.centre()) < 0.25f;
  for (size_t i = 0; i < near.size(); ++i)
    found += glm::distance(glm::vec3(near.x[i], near.y[i], near.z[i]), box.centre()) < 0.25f;
  EXPECT_GT(within, 100u);
  EXPECT_EQ(found, within);
  EXPECT_LT(near.size(), sources.size() / 2);
}

TEST(NearKernel, HoldsTheWindowedMass) {
  for (ProfileKind kind : {ProfileKind::kDipole, ProfileKind::kNormalizedDiffusion}) {
    const auto profile = makeProfile(kind, findMaterial("skin1", "").coefficients);
    const double radius = 5;
    const NearKernel near(*profile, radius);
    // Integral by parts: mass = integral of (P(0) - P(r)) (-dw/dr) dr.
    Rgb expected(0);
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
      const double a = radius * i / kSteps, b = radius * (i + 1) / kSteps;
      expected += (profile->P(0) - profile->P(0.5 * (a + b))) * (windowAt(a, radius) - windowAt(b, radius));
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(near.mass()[c], expected[c], 1e-3 * expected[c]);
    EXPECT_EQ(near.sampleRadius(0), 0);
    EXPECT_NEAR(near.sampleRadius(1), radius, 1e-9);
  }
}

TEST(NearField, FlatAndEvenlyLitHasNoNoise) {
  Scene scene;
  scene.objects = {test::object(builtinMesh("disc"), "skin1", 500)};
  scene.lights = {ParallelLight{.azimuth = 0, .elevation = 0}};
  scene.camera = OrbitCamera{.azimuth = 0, .elevation = 10, .factor = 1, .fov = 30};
  const RayScene rays(scene);
  const CameraReceivers receivers = findReceivers(rays, 8, 8);
  const auto profile = makeDipole(rays.medium(0));
  const NearField near(rays, 0, *profile, 0.01, -1);
  const RayHit& at = receivers.receivers[receivers.receivers.size() / 2].hit;
  const NearEstimate a = near.estimate(at, 16, 1), b = near.estimate(at, 64, 2);
  EXPECT_GT(a.radiosity.x, 0.1);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.radiosity[c] / b.radiosity[c], 1, 2e-3);
}

}  // namespace
}  // namespace lychnite
