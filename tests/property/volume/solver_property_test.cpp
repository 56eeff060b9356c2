#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <glm/geometric.hpp>

#include "lychnite/mesh/builtin.h"
#include "lychnite/mesh/load.h"
#include "lychnite/optics/materials.h"
#include "lychnite/volume/volume.h"

namespace lychnite {
namespace {

Scene sceneOf(const char* model, const char* material, double size) {
  Scene scene;
  scene.objects.push_back({.mesh = builtinMesh(model), .size = size});
  scene.objects[0].material.medium = findMaterial(material, "").coefficients;
  scene.lights.push_back(ParallelLight{.azimuth = 150, .elevation = 20});
  return scene;
}

const VolumeSettings kQuick{.cells = 24, .photons = 1 << 15};

std::vector<glm::vec3> radiosityOf(const Scene& scene, const VolumeSettings& settings = kQuick,
                                   VolumeSolver::Orders orders = VolumeSolver::Orders::kAll) {
  VolumeSolver solver;
  solver.update(scene, settings);
  return solver.vertexRadiosity(0, orders);
}

double worstDifference(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  double worst = 0, largest = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    worst = std::max(worst, double(glm::length(a[i] - b[i])));
    largest = std::max(largest, double(glm::length(a[i])));
  }
  return worst / largest;
}

TEST(VolumeProperty, EnergyIsKept) {
  for (const char* model : {"figurine"})
    for (const char* material : {"fig6", "skin1", "wholemilk", "ketchup"})
      for (const double size : {0.3, 10.0, 300.0}) {
        VolumeSolver solver;
        solver.update(sceneOf(model, material, size), {.cells = 24, .photons = 1 << 16});
        const VolumeStats& s = solver.stats();
        for (int c = 0; c < 3; ++c) {
          const double sum = s.left[c] + s.absorbed[c] + s.unscattered[c] + s.lost[c];
          EXPECT_NEAR(sum, 1, 0.01) << model << " " << material << " " << size << " mm, channel " << c;
          EXPECT_LT(s.lost[c], 0.002);
        }
      }
}

TEST(VolumeProperty, NothingIsAbsorbedWhereNothingAbsorbs) {
  Scene scene = sceneOf("figurine", "spectralon", 5);
  VolumeSolver solver;
  solver.update(scene, kQuick);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(solver.stats().left[c] + solver.stats().unscattered[c], 1, 0.01) << c;
}

TEST(VolumeProperty, SameBitsOnAnyNumberOfThreads) {
  const Scene scene = sceneOf("figurine", "skin1", 10);
  std::vector<glm::vec3> one, two;
  tbb::task_arena(1).execute([&] { one = radiosityOf(scene); });
  tbb::task_arena(2).execute([&] { two = radiosityOf(scene); });
  EXPECT_EQ(one, two);
}

TEST(VolumeProperty, WhatIsKeptEqualsWhatIsMadeAfresh) {
  VolumeSolver solver;
  VolumeSettings settings = kQuick;
  settings.tolerance = 1e-4;
  solver.update(sceneOf("figurine", "skin1", 10), settings);
  // Another size, material, light and intensity, one after the other.
  Scene scene = sceneOf("figurine", "fig6", 12);
  solver.update(scene, settings);
  scene.lights.push_back(PointLight{.position = {30, 20, 10}, .intensity = Rgb(900)});
  solver.update(scene, settings);
  std::get<PointLight>(scene.lights[1]).intensity = Rgb(500, 900, 100);
  solver.update(scene, settings);
  EXPECT_EQ(solver.stats().iterations, 0);  // intensities cost nothing
  EXPECT_LT(
      worstDifference(solver.vertexRadiosity(0, VolumeSolver::Orders::kAll), radiosityOf(scene, settings)),
      1e-3);
}

TEST(VolumeProperty, ScalesWithSizeAndCoefficientsTogether) {
  const Scene scene = sceneOf("figurine", "marble", 10);
  Scene scaled = scene;
  scaled.objects[0].size = 40;
  scaled.objects[0].material.medium = scene.objects[0].material.medium.scaled(4);
  EXPECT_LT(worstDifference(radiosityOf(scene), radiosityOf(scaled)), 0.01);
}

TEST(VolumeProperty, LightsAddUp) {
  Scene both = sceneOf("knot", "wholemilk", 20);
  const Scene first = both;
  both.lights.push_back(ParallelLight{.azimuth = -60, .elevation = 50, .irradiance = Rgb(1, 2, 3)});
  Scene second = both;
  second.lights.erase(second.lights.begin());
  auto sum = radiosityOf(first);
  const auto other = radiosityOf(second);
  for (size_t i = 0; i < sum.size(); ++i) sum[i] += other[i];
  EXPECT_LT(worstDifference(sum, radiosityOf(both)), 1e-3);
}

TEST(VolumeProperty, FirstOrderDoesNotDependOnWhereTracingEnds) {
  // The first collision is always traced; how many more must not change what leaves after it.
  const Scene scene = sceneOf("sphere", "fig6", 5);
  VolumeSettings one = kQuick, six = kQuick;
  one.collisions = 1;
  one.photons = six.photons = 1 << 17;
  const auto a = radiosityOf(scene, one, VolumeSolver::Orders::kFirst);
  const auto b = radiosityOf(scene, six, VolumeSolver::Orders::kFirst);
  glm::dvec3 sumA(0), sumB(0);
  for (size_t i = 0; i < a.size(); ++i) sumA += a[i], sumB += b[i];
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sumA[c] / sumB[c], 1, 0.08) << c;
}

/// Two boxes, one behind the other seen along z, `gap` apart; the whole is 1 long in x.
std::shared_ptr<const Mesh> twoWalls(float thickness, float gap) {
  Mesh mesh;
  for (const float z : {0.0f, -thickness - gap}) {
    const auto first = uint32_t(mesh.positions.size());
    for (int i = 0; i < 8; ++i)
      mesh.positions.emplace_back(i & 1 ? 1.0f : 0.0f, i & 2 ? 1.0f : 0.0f, i & 4 ? z : z - thickness);
    // The faces across z have a vertex in their middles.
    mesh.positions.emplace_back(0.5f, 0.5f, z - thickness);
    mesh.positions.emplace_back(0.5f, 0.5f, z);
    const uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (uint32_t f = 0; f < 6; ++f) {
      const auto corner = [&](uint32_t c) { return first + faces[f][c % 4]; };
      if (f < 2) {
        for (uint32_t c = 0; c < 4; ++c) mesh.triangles.push_back({corner(c), corner(c + 1), first + 8 + f});
      } else {
        mesh.triangles.push_back({corner(0), corner(1), corner(2)});
        mesh.triangles.push_back({corner(0), corner(2), corner(3)});
      }
    }
  }
  return repairMesh(std::move(mesh), "walls").mesh;
}

TEST(VolumeProperty, NothingLeaksThroughAWallOrAcrossAFold) {
  // Walls of less than a cell, twenty absorption lengths thick, a gap of a tenth of a cell. Light from +z.
  constexpr float kWall = 0.03f, kGap = 0.004f;
  Scene scene;
  scene.objects.push_back({.mesh = twoWalls(kWall, kGap), .size = 1000});
  scene.objects[0].material.medium = {.sigma_s = Rgb(1), .sigma_a = Rgb(0.2), .eta = 1.3};
  scene.lights.push_back(ParallelLight{.azimuth = 0, .elevation = 0});
  const auto radiosity = radiosityOf(scene);
  const auto& positions = scene.objects[0].mesh->positions;
  double front = 0, behind = 0;
  for (size_t i = 0; i < radiosity.size(); ++i) {
    if (positions[i].x != 0.5f) continue;
    const bool lit = positions[i].z > -0.5f * kWall;
    (lit ? front : behind) = std::max(lit ? front : behind, double(radiosity[i].x));
  }
  EXPECT_GT(front, 0.1);
  EXPECT_LT(behind, 1e-3 * front);
}

TEST(VolumeProperty, OpenMeshesAreAnObstacle) {
  VolumeSolver solver;
  EXPECT_EQ(solver.obstacle(sceneOf("figurine", "marble", 10)), "");
  EXPECT_NE(solver.obstacle(sceneOf("disc", "marble", 10)), "");
  Scene opaque = sceneOf("disc", "marble", 10);
  opaque.objects[0].material.opaque = true;
  EXPECT_EQ(solver.obstacle(opaque), "");
}

}  // namespace
}  // namespace lychnite
