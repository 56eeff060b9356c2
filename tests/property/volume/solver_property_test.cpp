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
                                   VolumeSolver::Orders orders = VolumeSolver::Orders::kAll, int passes = 1) {
  VolumeSolver solver;
  solver.update(scene, settings);
  for (int pass = 0; pass < passes; ++pass) solver.refine();
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
        for (int pass = 0; pass < 2; ++pass) {
          const VolumeStats& s = solver.stats();
          EXPECT_EQ(s.passes, pass);
          for (int c = 0; c < 3; ++c) {
            const double sum = s.left[c] + s.absorbed[c] + s.unscattered[c] + s.lost[c];
            EXPECT_NEAR(sum, 1, 0.01) << model << " " << material << " " << size << " mm, channel " << c;
            EXPECT_LT(s.lost[c], 0.002);
          }
          solver.refine();
        }
      }
}

TEST(VolumeProperty, NothingIsAbsorbedWhereNothingAbsorbs) {
  Scene scene = sceneOf("figurine", "spectralon", 5);
  VolumeSolver solver;
  solver.update(scene, kQuick);
  for (int pass = 0; pass < 2; ++pass, solver.refine())
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(solver.stats().left[c] + solver.stats().unscattered[c], 1, 0.01) << c << " pass " << pass;
}

TEST(VolumeProperty, SameBitsOnAnyNumberOfThreads) {
  const Scene scene = sceneOf("figurine", "skin1", 10);
  std::vector<glm::vec3> one, two;
  tbb::task_arena(1).execute([&] { one = radiosityOf(scene); });
  tbb::task_arena(2).execute([&] { two = radiosityOf(scene); });
  EXPECT_EQ(one, two);
}

TEST(VolumeProperty, ASeedSaysWhichPicture) {
  const Scene scene = sceneOf("figurine", "skin1", 10);
  const auto withSeed = [&](uint64_t seed) {
    VolumeSolver solver;
    VolumeSettings settings = kQuick;
    settings.seed = seed;
    solver.update(scene, settings);
    solver.refine();
    return solver.vertexRadiosity(0, VolumeSolver::Orders::kAll);
  };
  const auto one = withSeed(7);
  EXPECT_EQ(one, withSeed(7));
  EXPECT_NE(one, withSeed(8));
}

/// Relative root mean square of the difference.
double difference(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  double squares = 0, sum = 0;
  for (size_t v = 0; v < a.size(); ++v) {
    squares += double(glm::dot(a[v] - b[v], a[v] - b[v]));
    sum += double(glm::dot(b[v], b[v]));
  }
  return std::sqrt(squares / sum);
}

TEST(VolumeProperty, TheFirstPictureIsNearTheLast) {
  VolumeSettings settings = kQuick;
  settings.cells = 32;  // of 24, photons at 100 mm tell more than cells do: .102
  for (const double size : {3.0, 10.0, 100.0}) {
    VolumeSolver solver;
    solver.update(sceneOf("figurine", "fig6", size), settings);
    EXPECT_EQ(solver.stats().flights, 0) << "no photons";
    const auto first = solver.vertexRadiosity(0, VolumeSolver::Orders::kAll);
    const auto firstOrder = solver.vertexRadiosity(0, VolumeSolver::Orders::kFirst);
    for (int pass = 0; pass < 4; ++pass) solver.refine();
    EXPECT_LT(difference(first, solver.vertexRadiosity(0, VolumeSolver::Orders::kAll)), 0.1) << size;
    // Light that was mirrored inside before or after its collision is missing: more where the light passes.
    EXPECT_LT(difference(firstOrder, solver.vertexRadiosity(0, VolumeSolver::Orders::kFirst)), 0.35) << size;
  }
}

TEST(VolumeProperty, PointsTellWhatVerticesTell) {
  const Scene scene = sceneOf("figurine", "skin1", 10);
  VolumeSolver solver;
  solver.update(scene, kQuick);
  const Mesh& mesh = *scene.objects[0].mesh;
  std::vector<MeshPoint> points;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) points.push_back({t, t % 2 ? 1.0f : 0.0f, 0});
  const auto at = solver.pointRadiosity(0, points, VolumeSolver::Orders::kAll);
  const auto vertices = solver.vertexRadiosity(0, VolumeSolver::Orders::kAll);
  size_t other = 0;  // a vertex between two cells takes one of them
  for (uint32_t t = 0; t < points.size(); ++t) {
    const glm::vec3 vertex = vertices[mesh.triangles[t][t % 2]];
    other += glm::length(at[t] - vertex) > 0.01f * glm::length(vertex);
  }
  EXPECT_LT(other, points.size() / 10);
}

TEST(VolumeProperty, TheFirstPictureDoesNotDependOnTheSeed) {
  VolumeSolver solvers[2];
  std::vector<glm::vec3> values[2];
  for (uint64_t i : {0, 1}) {
    VolumeSettings settings = kQuick;
    settings.seed = 100 + i;
    solvers[i].update(sceneOf("sphere", "skin1", 10), settings);
    values[i] = solvers[i].vertexRadiosity(0, VolumeSolver::Orders::kAll);
  }
  EXPECT_EQ(values[0], values[1]);
}

TEST(VolumeProperty, OrdersAddUp) {
  VolumeSolver solver;
  solver.update(sceneOf("figurine", "skin1", 10), kQuick);
  for (int pass = 0; pass < 2; ++pass, solver.refine()) {
    const auto all = solver.vertexRadiosity(0, VolumeSolver::Orders::kAll);
    auto sum = solver.vertexRadiosity(0, VolumeSolver::Orders::kFirst);
    const auto multiple = solver.vertexRadiosity(0, VolumeSolver::Orders::kMultiple);
    for (size_t v = 0; v < sum.size(); ++v) sum[v] += multiple[v];
    EXPECT_LT(worstDifference(sum, all), 1e-5);
  }
}

TEST(VolumeProperty, NoiseIsWhatRunsDifferBy) {
  const Scene scene = sceneOf("figurine", "fig6", 5);
  VolumeSolver solvers[2];
  for (uint64_t i : {0, 1}) {
    VolumeSettings settings = kQuick;
    settings.seed = 100 + i;
    solvers[i].update(scene, settings);
    EXPECT_EQ(solvers[i].noise(), 0) << "no photons, no noise";
  }
  for (const int passes : {3, 12}) {
    std::vector<glm::vec3> values[2];
    for (int i : {0, 1}) {
      while (solvers[i].stats().passes < passes) solvers[i].refine();
      values[i] = solvers[i].vertexRadiosity(0, VolumeSolver::Orders::kAll);
    }
    double squares = 0, sum = 0;
    for (size_t v = 0; v < values[0].size(); ++v)
      for (int c = 0; c < 3; ++c) {
        const double a = double(values[0][v][c]), b = double(values[1][v][c]);
        squares += 0.5 * (a - b) * (a - b);
        sum += 0.5 * (a + b);
      }
    const double n = 3 * double(values[0].size()), seen = std::sqrt(squares / n) / (sum / n);
    EXPECT_LT(solvers[0].noise(), 2 * seen) << passes;
    EXPECT_GT(solvers[0].noise(), 0.5 * seen) << passes;
  }
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
  solver.refine();
  EXPECT_LT(
      worstDifference(solver.vertexRadiosity(0, VolumeSolver::Orders::kAll), radiosityOf(scene, settings)),
      1e-3);
}

TEST(VolumeProperty, ALightThatMovedCountsAnew) {
  VolumeSolver solver;
  Scene scene = sceneOf("figurine", "skin1", 10);
  scene.lights.push_back(ParallelLight{.azimuth = -40, .elevation = 30});
  solver.update(scene, kQuick);
  for (int pass = 0; pass < 3; ++pass) solver.refine();
  EXPECT_EQ(solver.stats().passes, 3);
  std::get<ParallelLight>(scene.lights[1]).azimuth = -41;
  solver.update(scene, kQuick);
  EXPECT_EQ(solver.stats().passes, 0);  // of the light that has fewest: there is more to do
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
  // Photons are smoothed as all lights together bear it, so that their noise does not add up.
  for (const int passes : {0, 1}) {
    auto sum = radiosityOf(first, kQuick, VolumeSolver::Orders::kAll, passes);
    const auto other = radiosityOf(second, kQuick, VolumeSolver::Orders::kAll, passes);
    for (size_t i = 0; i < sum.size(); ++i) sum[i] += other[i];
    const auto together = radiosityOf(both, kQuick, VolumeSolver::Orders::kAll, passes);
    EXPECT_LT(worstDifference(sum, together), passes == 0 ? 1e-3 : 0.05);
  }
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

struct Box {
  glm::vec3 low, high;
};

/// Boxes whose faces across z have a vertex in their middles. They may overlap: the inside is that of all.
std::shared_ptr<const Mesh> boxes(const std::vector<Box>& all) {
  Mesh mesh;
  for (const Box& box : all) {
    const auto first = uint32_t(mesh.positions.size());
    for (int i = 0; i < 8; ++i)
      mesh.positions.emplace_back(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                                  i & 4 ? box.high.z : box.low.z);
    const glm::vec3 middle = 0.5f * (box.low + box.high);
    mesh.positions.emplace_back(middle.x, middle.y, box.low.z);
    mesh.positions.emplace_back(middle.x, middle.y, box.high.z);
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
  return repairMesh(std::move(mesh), "boxes").mesh;
}

/// Radiosity at the middles of the faces across z, of light from +z on a thing 1 m long: on the front, and
/// the most elsewhere.
std::pair<double, double> frontAndElsewhere(const std::shared_ptr<const Mesh>& mesh, float frontZ) {
  Scene scene;
  scene.objects.push_back({.mesh = mesh, .size = 1000});
  scene.objects[0].material.medium = {.sigma_s = Rgb(1), .sigma_a = Rgb(0.2), .eta = 1.3};
  scene.lights.push_back(ParallelLight{.azimuth = 0, .elevation = 0});
  const auto radiosity = radiosityOf(scene);
  double front = 0, elsewhere = 0;
  for (size_t i = 0; i < radiosity.size(); ++i) {
    const glm::vec3& p = mesh->positions[i];
    if (p.x != 0.5f || std::abs(p.y - 0.5f) > 0.2f) continue;
    double& most = p.z == frontZ ? front : elsewhere;
    most = std::max(most, double(radiosity[i].x));
  }
  return {front, elsewhere};
}

TEST(VolumeProperty, NothingLeaksThroughAWallOrAcrossAGap) {
  // Walls of less than a cell, twenty absorption lengths thick, a gap of a tenth of a cell.
  constexpr float kWall = 0.03f, kGap = 0.004f;
  const auto [front, elsewhere] = frontAndElsewhere(
      boxes({{{0, 0, -kWall}, {1, 1, 0}}, {{0, 0, -2 * kWall - kGap}, {1, 1, -kWall - kGap}}}), 0);
  EXPECT_GT(front, 0.1);
  EXPECT_LT(elsewhere, 1e-3 * front);
}

TEST(VolumeProperty, TheInsideOfAFoldIsDark) {
  // Two flaps that hang together at their lower edge, a slit of a tenth of a cell between them: of the flaps'
  // four faces only the front one is lit, though light enters the solid on both sides of the slit's bottom.
  constexpr float kFlap = 0.03f, kSlit = 0.004f, kBack = -2 * kFlap - kSlit;
  const auto [front, elsewhere] = frontAndElsewhere(boxes({{{0, 0, -kFlap}, {1, 1, 0}},
                                                           {{0, 0, kBack}, {1, 1, -kFlap - kSlit}},
                                                           {{0, -0.1f, kBack}, {1, 0.05f, 0}}}),
                                                    0);
  EXPECT_GT(front, 0.1);
  EXPECT_LT(elsewhere, 1e-3 * front);
}

TEST(VolumeProperty, MoreCellsWhereOneIsLongerThanAMeanFreePath) {
  Scene scene = sceneOf("sphere", "marble", 10);
  EXPECT_EQ(volumeCells(scene), 64);
  scene.objects[0].size = 100;
  EXPECT_EQ(volumeCells(scene), 96);
  scene.objects[0].material.medium.g = 0.99;  // hardly scatters
  EXPECT_EQ(volumeCells(scene), 64);
  scene.objects[0].material.medium.g = 0;
  scene.objects[0].material.opaque = true;
  EXPECT_EQ(volumeCells(scene), 64);
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
