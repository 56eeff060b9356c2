#include "lychnite/mesh/builtin.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "lychnite/mesh/load.h"
#include "mesh/builtin/models.h"

namespace lychnite {
namespace {

TEST(BuiltinModels, ListsNamesThatAreMade) {
  std::vector<std::string> names;
  for (const BuiltinModel& model : builtinModels()) {
    names.push_back(model.name);
    EXPECT_FALSE(model.description.empty());
    const auto mesh = builtinMesh(model.name);
    ASSERT_TRUE(mesh) << model.name;
    EXPECT_EQ(mesh->triangles.size(), model.triangles) << model.name;
    EXPECT_EQ(mesh->positions.size(), model.vertices) << model.name;
    EXPECT_EQ(mesh->normals.size(), model.vertices) << model.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"sphere", "slab", "disc", "knot", "stone"}));
}

TEST(BuiltinModels, UnknownNameIsNothing) {
  EXPECT_FALSE(builtinMesh("teapot"));
  EXPECT_FALSE(builtinMesh(""));
}

TEST(BuiltinModels, SecondCallGivesTheSameMesh) {
  EXPECT_EQ(builtinMesh("slab"), builtinMesh("slab"));
}

TEST(BuiltinModels, LongestSideIsOneAndCentred) {
  for (const BuiltinModel& model : builtinModels()) {
    const Bounds bounds = boundsOf(*builtinMesh(model.name));
    EXPECT_NEAR(bounds.longestSide(), 1, 1e-6) << model.name;
    EXPECT_LT(glm::length(bounds.centre()), 1e-6) << model.name;
  }
}

TEST(BuiltinModels, ClosedOfOnePieceAndFacingOutwards) {
  for (const BuiltinModel& model : builtinModels()) {
    const MeshInfo info = inspect(*builtinMesh(model.name));
    EXPECT_EQ(info.closed, model.name != "disc") << model.name;
    EXPECT_EQ(info.non_manifold_edges, 0u) << model.name;
    EXPECT_EQ(info.components, 1u) << model.name;
    if (info.closed) {
      EXPECT_GT(info.volume, 0) << model.name;
    }
  }
}

TEST(BuiltinModels, NormalsAreUnitAndAgreeWithTheFaces) {
  for (const BuiltinModel& model : builtinModels()) {
    const auto mesh = builtinMesh(model.name);
    for (const glm::vec3& n : mesh->normals) ASSERT_NEAR(glm::length(n), 1, 1e-5) << model.name;
    for (const glm::uvec3& t : mesh->triangles) {
      const glm::vec3 a = mesh->positions[t.x], b = mesh->positions[t.y], c = mesh->positions[t.z];
      const glm::vec3 face = glm::normalize(glm::cross(b - a, c - a));
      for (int i = 0; i < 3; ++i) ASSERT_GT(glm::dot(face, mesh->normals[t[i]]), 0.3f) << model.name;
    }
  }
}

/// Twice the inradius over the circumradius: 1 for an equilateral triangle, 0 for a degenerate one.
double shapeQuality(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double u = glm::length(b - a), v = glm::length(c - b), w = glm::length(a - c);
  return (u + v - w) * (v + w - u) * (w + u - v) / (u * v * w);
}

TEST(BuiltinModels, NoSlivers) {
  for (const BuiltinModel& model : builtinModels()) {
    const auto mesh = builtinMesh(model.name);
    double worst = 1;
    for (const glm::uvec3& t : mesh->triangles)
      worst = std::min(worst, shapeQuality(mesh->positions[t.x], mesh->positions[t.y], mesh->positions[t.z]));
    EXPECT_GT(worst, 0.05) << model.name;
  }
}

TEST(BuiltinModels, SphereIsRound) {
  const auto sphere = builtinMesh("sphere");
  for (size_t i = 0; i < sphere->positions.size(); ++i) {
    ASSERT_NEAR(glm::length(sphere->positions[i]), 0.5, 1e-6);
    ASSERT_GT(glm::dot(sphere->normals[i], 2.0f * sphere->positions[i]), 0.9999f);
  }
  // Chords of length h lie within h^2 / (8 r) of the sphere; h is about 0.02.
  const MeshInfo info = inspect(*sphere);
  EXPECT_NEAR(info.volume, std::numbers::pi / 6, 1e-3);
  EXPECT_NEAR(info.area, std::numbers::pi, 2e-3);
}

TEST(BuiltinModels, SlabIsAnExactBox) {
  const auto slab = builtinMesh("slab");
  const MeshInfo info = inspect(*slab);
  EXPECT_NEAR(info.volume, 0.1, 1e-6);
  EXPECT_NEAR(info.area, 2.4, 1e-6);
  for (size_t i = 0; i < slab->positions.size(); ++i) {
    const glm::vec3 n = slab->normals[i], half(0.5f, 0.5f, 0.05f);
    ASSERT_NEAR(glm::max(glm::abs(n.x), glm::max(glm::abs(n.y), glm::abs(n.z))), 1, 1e-6);
    ASSERT_NEAR(glm::dot(n, slab->positions[i]), glm::dot(glm::abs(n), half), 1e-6);
  }
}

TEST(BuiltinModels, DiscIsFlatAndFacesZ) {
  const auto disc = builtinMesh("disc");
  const MeshInfo info = inspect(*disc);
  EXPECT_EQ(info.boundary_edges, 512u);
  EXPECT_NEAR(info.area, std::numbers::pi / 4, 1e-4);
  for (const glm::vec3& p : disc->positions) ASSERT_EQ(p.z, 0);
  for (const glm::vec3& n : disc->normals) ASSERT_EQ(n, glm::vec3(0, 0, 1));
}

}  // namespace
}  // namespace lychnite
