#include <gtest/gtest.h>

#include <cmath>

#include "lychnite/mesh/load.h"
#include "unit/mesh/sample_files.h"

namespace lychnite {
namespace {

TEST(Inspect, MeasuresABox) {
  const MeshInfo info = inspect(sample::box());
  EXPECT_EQ(info.vertices, 8u);
  EXPECT_EQ(info.triangles, 12u);
  EXPECT_EQ(info.components, 1u);
  EXPECT_EQ(info.boundary_edges, 0u);
  EXPECT_EQ(info.non_manifold_edges, 0u);
  EXPECT_TRUE(info.closed);
  EXPECT_DOUBLE_EQ(info.area, 22.0);
  EXPECT_DOUBLE_EQ(info.volume, 6.0);
  EXPECT_EQ(info.bounds.max, glm::dvec3(1, 2, 3));
  EXPECT_GE(info.memory_bytes, 8u * 12 + 12u * 12);
}

TEST(Inspect, VolumeDoesNotDependOnThePlace) {
  Mesh mesh = sample::box();
  for (auto& p : mesh.positions) p += glm::vec3(4096, -8192, 4096);
  EXPECT_NEAR(inspect(mesh).volume, 6.0, 1e-9);
}

TEST(Inspect, CountsTheEdgesOfAHole) {
  Mesh mesh = sample::box();
  mesh.triangles.resize(10);  // without the last quad
  const MeshInfo info = inspect(mesh);
  EXPECT_EQ(info.boundary_edges, 4u);
  EXPECT_FALSE(info.closed);
}

TEST(Inspect, FindsComponentsByPosition) {
  Mesh mesh = sample::box();
  for (const auto& p : sample::kCorners) mesh.positions.push_back(p + glm::vec3(5, 0, 0));
  for (glm::uvec3 t : sample::triangles()) mesh.triangles.push_back(t + 8u);
  mesh.positions.push_back({20, 0, 0});  // an unused vertex is no component
  EXPECT_EQ(inspect(mesh).components, 2u);
  EXPECT_TRUE(inspect(mesh).closed);
  // Two boxes that share the four corners of a side, each with vertices of its own.
  for (size_t v = 8; v < 16; ++v) mesh.positions[v].x -= 4;
  const MeshInfo touching = inspect(mesh);
  EXPECT_EQ(touching.components, 1u);
  EXPECT_GT(touching.non_manifold_edges, 0u);
  EXPECT_FALSE(touching.closed);
}

TEST(Inspect, SeesATriangleThatFacesTheWrongWay) {
  Mesh mesh = sample::box();
  std::swap(mesh.triangles[4].x, mesh.triangles[4].y);
  const MeshInfo info = inspect(mesh);
  EXPECT_EQ(info.boundary_edges, 0u);
  EXPECT_EQ(info.non_manifold_edges, 0u);
  EXPECT_FALSE(info.closed);
}

TEST(Inspect, NothingIsNotClosed) {
  const MeshInfo info = inspect(Mesh{});
  EXPECT_FALSE(info.closed);
  EXPECT_EQ(info.components, 0u);
}

}  // namespace
}  // namespace lychnite
