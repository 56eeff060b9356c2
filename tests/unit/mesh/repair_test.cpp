#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>

#include "lychnite/base/error.h"
#include "lychnite/mesh/load.h"
#include "unit/mesh/sample_files.h"

namespace lychnite {
namespace {

std::string errorOf(Mesh mesh) {
  try {
    repairMesh(std::move(mesh), "somewhere");
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

// Every triangle with corners of its own, as STL has them.
Mesh soup(const Mesh& mesh) {
  Mesh out;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto first = static_cast<uint32_t>(out.positions.size());
    for (int i = 0; i < 3; ++i) out.positions.push_back(mesh.positions[t[i]]);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

TEST(Repair, LeavesASoundMeshAsItIs) {
  const LoadedMesh loaded = repairMesh(sample::box(), "box");
  EXPECT_EQ(loaded.mesh->positions, sample::box().positions);
  EXPECT_EQ(loaded.mesh->triangles, sample::box().triangles);
  EXPECT_EQ(loaded.report.file_vertices, 8u);
  EXPECT_EQ(loaded.report.file_triangles, 12u);
  EXPECT_EQ(loaded.report.duplicate_vertices, 0u);
  EXPECT_EQ(loaded.report.degenerate_triangles, 0u);
  EXPECT_EQ(loaded.report.unused_vertices, 0u);
  EXPECT_TRUE(loaded.report.normals_made);
  EXPECT_FALSE(loaded.report.flipped);
  EXPECT_EQ(loaded.mesh->normals.size(), 8u);
}

TEST(Repair, WeldsASoup) {
  const LoadedMesh loaded = repairMesh(soup(sample::box()), "box");
  EXPECT_EQ(loaded.report.file_vertices, 36u);
  EXPECT_EQ(loaded.report.duplicate_vertices, 28u);
  EXPECT_EQ(loaded.mesh->positions.size(), 8u);
  EXPECT_TRUE(inspect(*loaded.mesh).closed);
}

TEST(Repair, WeldsMinusZeroWithZeroButNothingNearby) {
  Mesh mesh;
  const float next = std::nextafter(1.0f, 2.0f);
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0f, 0, -0.0f}, {next, 0, 0}, {0, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 5, 4}};
  const LoadedMesh loaded = repairMesh(std::move(mesh), "two");
  EXPECT_EQ(loaded.report.duplicate_vertices, 1u);
  EXPECT_EQ(loaded.mesh->positions.size(), 5u);
}

TEST(Repair, DropsDegenerateTrianglesAndUnusedVertices) {
  Mesh mesh = sample::box();
  mesh.positions.insert(mesh.positions.end(), {{0.5f, 0, 0}, {9, 9, 9}, {0, 0, 0}});
  mesh.triangles.push_back({0, 0, 1});   // the same corner twice
  mesh.triangles.push_back({0, 1, 8});   // in line
  mesh.triangles.push_back({0, 10, 2});  // two vertices in one place
  const LoadedMesh loaded = repairMesh(std::move(mesh), "box");
  EXPECT_EQ(loaded.report.file_triangles, 15u);
  EXPECT_EQ(loaded.report.degenerate_triangles, 3u);
  EXPECT_EQ(loaded.report.duplicate_vertices, 1u);
  EXPECT_EQ(loaded.report.unused_vertices, 2u);
  EXPECT_EQ(loaded.mesh->positions, sample::box().positions);
  EXPECT_EQ(loaded.mesh->triangles, sample::box().triangles);
}

TEST(Repair, KeepsThinSlivers) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5f, 1e-7f, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(repairMesh(std::move(mesh), "sliver").report.degenerate_triangles, 0u);
}

TEST(Repair, TurnsAClosedMeshThatIsInsideOut) {
  Mesh mesh = sample::box();
  for (auto& t : mesh.triangles) std::swap(t.x, t.y);
  const LoadedMesh loaded = repairMesh(std::move(mesh), "box");
  EXPECT_TRUE(loaded.report.flipped);
  EXPECT_DOUBLE_EQ(inspect(*loaded.mesh).volume, 6.0);
  EXPECT_LT(loaded.mesh->normals[0].x, 0.0f);
}

TEST(Repair, LeavesAnOpenMeshAsItFaces) {
  Mesh mesh = sample::box();
  for (auto& t : mesh.triangles) std::swap(t.x, t.y);
  mesh.triangles.pop_back();
  const auto before = mesh.triangles;
  const LoadedMesh loaded = repairMesh(std::move(mesh), "box");
  EXPECT_FALSE(loaded.report.flipped);
  EXPECT_EQ(loaded.mesh->triangles, before);
}

// Face normals of a box: each corner splits in three, and the split is no hole.
Mesh flatShadedBox() {
  Mesh mesh = soup(sample::box());
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 normal = glm::normalize(
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
    mesh.normals.insert(mesh.normals.end(), 3, normal);
  }
  return mesh;
}

TEST(Repair, KeepsTheCreasesOfTheFilesNormals) {
  const LoadedMesh loaded = repairMesh(flatShadedBox(), "box");
  EXPECT_FALSE(loaded.report.normals_made);
  EXPECT_EQ(loaded.mesh->positions.size(), 24u);
  EXPECT_EQ(loaded.report.duplicate_vertices, 12u);
  const MeshInfo info = inspect(*loaded.mesh);
  EXPECT_TRUE(info.closed);
  EXPECT_EQ(info.components, 1u);
}

TEST(Repair, TurnsNormalsThatOpposeTheirTriangles) {
  Mesh mesh = flatShadedBox();
  const glm::vec3 outwards = mesh.normals[0];
  for (auto& n : mesh.normals) n *= -3.0f;
  const LoadedMesh loaded = repairMesh(std::move(mesh), "box");
  EXPECT_EQ(loaded.mesh->normals[0], outwards);
}

TEST(Repair, TurnsTheNormalsWithAnInsideOutMesh) {
  Mesh mesh = flatShadedBox();
  const glm::vec3 outwards = mesh.normals[0];
  for (auto& n : mesh.normals) n = -n;
  for (auto& t : mesh.triangles) std::swap(t.x, t.y);
  const LoadedMesh loaded = repairMesh(std::move(mesh), "box");
  EXPECT_TRUE(loaded.report.flipped);
  EXPECT_EQ(loaded.mesh->normals[0], outwards);
}

TEST(Repair, RemakesUnusableNormals) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const glm::vec3 bad : {glm::vec3(0), glm::vec3(nan, 0, 1)}) {
    Mesh mesh = flatShadedBox();
    mesh.normals[7] = bad;
    const LoadedMesh loaded = repairMesh(std::move(mesh), "box");
    EXPECT_TRUE(loaded.report.normals_made);
    EXPECT_EQ(loaded.mesh->positions.size(), 8u);
  }
}

TEST(Repair, AcceptsAFlatMesh) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const LoadedMesh loaded = repairMesh(std::move(mesh), "square");
  EXPECT_EQ(loaded.mesh->normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(inspect(*loaded.mesh).boundary_edges, 4u);
}

TEST(Repair, RefusesWhatCannotBeRendered) {
  Mesh mesh = sample::box();
  mesh.positions[3].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(errorOf(mesh).find("NaN"), std::string::npos);
  EXPECT_NE(errorOf(mesh).find("vertex 3"), std::string::npos);
  mesh.positions[3].y = std::numeric_limits<float>::infinity();
  EXPECT_NE(errorOf(mesh).find("vertex 3"), std::string::npos);

  mesh = sample::box();
  mesh.triangles[5].z = 8;
  EXPECT_EQ(errorOf(mesh).rfind("somewhere: ", 0), 0u);
  EXPECT_NE(errorOf(mesh).find("index 8 in triangle 5"), std::string::npos);

  mesh = sample::box();
  mesh.triangles.clear();
  EXPECT_NE(errorOf(mesh).find("no face"), std::string::npos);

  mesh = sample::box();
  for (auto& p : mesh.positions) p = {2, 2, 2};
  EXPECT_NE(errorOf(mesh).find("extent"), std::string::npos);

  mesh = sample::box();
  for (auto& p : mesh.positions) p = {p.x + p.z, 1, 1};
  EXPECT_NE(errorOf(mesh).find("all 12 triangles are degenerate"), std::string::npos);
}

}  // namespace
}  // namespace lychnite
