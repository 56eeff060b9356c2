#include "lychnite/mesh/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "lychnite/mesh/load.h"
#include "unit/mesh/sample_files.h"

namespace lychnite {
namespace {

TEST(Bounds, HoldAllPositionsAndNameTheLongestSide) {
  Mesh mesh;
  mesh.positions = {{1, -2, 3}, {-1, 5, 3.5f}, {0, 0, 4}};
  const Bounds bounds = boundsOf(mesh);
  EXPECT_EQ(bounds.min, glm::dvec3(-1, -2, 3));
  EXPECT_EQ(bounds.max, glm::dvec3(1, 5, 4));
  EXPECT_EQ(bounds.centre(), glm::dvec3(0, 1.5, 3.5));
  EXPECT_EQ(bounds.longestSide(), 7.0);
}

TEST(Bounds, OfNothingAreZero) {
  EXPECT_EQ(boundsOf(Mesh{}).longestSide(), 0.0);
}

TEST(Mesh, CountsItsMemory) {
  Mesh mesh;
  mesh.positions.reserve(10);
  mesh.normals.reserve(10);
  mesh.triangles.reserve(20);
  EXPECT_EQ(mesh.memoryBytes(), 10u * 12 + 10u * 12 + 20u * 12);
}

// Weighting by angle makes a box corner's normal the diagonal however its faces are cut; by area or by
// triangle count it would lean.
TEST(Normals, OfABoxAreDiagonal) {
  const Mesh box = sample::box();
  const auto normals = angleWeightedNormals(box.positions, box.triangles);
  ASSERT_EQ(normals.size(), 8u);
  for (size_t v = 0; v < 8; ++v) {
    const glm::vec3 p = box.positions[v];
    const glm::dvec3 diagonal(p.x > 0 ? 1 : -1, p.y > 0 ? 1 : -1, p.z > 0 ? 1 : -1);
    EXPECT_LT(glm::length(glm::dvec3(normals[v]) - diagonal / std::sqrt(3.0)), 1e-6) << "vertex " << v;
  }
}

// An octahedron cut twelve times along each edge and blown up: irregular triangles, known normals. The bound
// is what was measured (0.0073) with some room; unweighted normals miss it (0.0097).
TEST(Normals, OfASphereAreRadial) {
  constexpr int kCuts = 12;
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (int octant = 0; octant < 8; ++octant) {
    const glm::vec3 sign(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
    const bool mirrored = sign.x * sign.y * sign.z < 0;
    const auto point = [&](int i, int j) { return sign * glm::normalize(glm::vec3(i, j, kCuts - i - j)); };
    const auto add = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
      const auto first = static_cast<uint32_t>(positions.size());
      positions.insert(positions.end(), {a, mirrored ? c : b, mirrored ? b : c});
      triangles.push_back({first, first + 1, first + 2});
    };
    for (int i = 0; i < kCuts; ++i)
      for (int j = 0; i + j < kCuts; ++j) {
        add(point(i, j), point(i + 1, j), point(i, j + 1));
        if (i + j + 1 < kCuts) add(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
      }
  }
  Mesh soup{positions, {}, triangles};
  const auto mesh = repairMesh(std::move(soup), "sphere").mesh;
  ASSERT_EQ(mesh->positions.size(), 4u * kCuts * kCuts + 2);
  double worst = 0;
  for (size_t v = 0; v < mesh->positions.size(); ++v)
    worst = std::max(worst, double(glm::length(mesh->normals[v] - mesh->positions[v])));
  EXPECT_LT(worst, 0.008);
}

TEST(Normals, WithoutAreaPointUp) {
  const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {5, 5, 5}};
  const std::vector<glm::uvec3> back_to_back = {{0, 1, 3}, {0, 3, 1}, {0, 1, 2}};
  for (const glm::vec3& n : angleWeightedNormals(positions, back_to_back)) EXPECT_EQ(n, glm::vec3(0, 1, 0));
}

TEST(Normals, OfTinyAndHugeTrianglesAreUnit) {
  for (const float size : {1e-30f, 1e30f}) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
    for (const glm::vec3& n : angleWeightedNormals(positions, {{0, 1, 2}})) EXPECT_EQ(n, glm::vec3(0, 0, 1));
  }
}

}  // namespace
}  // namespace lychnite
