#include "lychnite/mesh/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

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
