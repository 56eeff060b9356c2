#include "lychnite/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lychnite {
namespace {

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

double Bounds::longestSide() const {
  const glm::dvec3 side = extent();
  return std::max({side.x, side.y, side.z});
}

size_t Mesh::memoryBytes() const {
  return positions.capacity() * sizeof(positions[0]) + normals.capacity() * sizeof(normals[0]) +
         triangles.capacity() * sizeof(triangles[0]);
}

Bounds boundsOf(const Mesh& mesh) {
  if (mesh.positions.empty()) return {};
  Bounds bounds{mesh.positions[0], mesh.positions[0]};
  for (const glm::dvec3 p : mesh.positions) {
    bounds.min = glm::min(bounds.min, p);
    bounds.max = glm::max(bounds.max, p);
  }
  return bounds;
}

Extent extentOf(const Mesh& mesh) {
  if (mesh.extent) return *mesh.extent;
  Extent extent{boundsOf(mesh), 0};
  const glm::dvec3 centre = extent.bounds.centre();
  double r2 = 0;
  for (const glm::dvec3 p : mesh.positions) r2 = std::max(r2, glm::dot(p - centre, p - centre));
  extent.radius = std::sqrt(r2);
  return extent;
}

std::vector<glm::vec3> angleWeightedNormals(const std::vector<glm::vec3>& positions,
                                            const std::vector<glm::uvec3>& triangles) {
  std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0));
  for (const glm::uvec3& t : triangles) {
    const glm::dvec3 a = positions[t.x], b = positions[t.y], c = positions[t.z];
    const glm::dvec3 across = glm::cross(b - a, c - a);
    const double twice_area = glm::length(across);
    if (!(twice_area > 0)) continue;
    const glm::dvec3 normal = across / twice_area;
    sums[t.x] += angleBetween(b - a, c - a) * normal;
    sums[t.y] += angleBetween(c - b, a - b) * normal;
    sums[t.z] += angleBetween(a - c, b - c) * normal;
  }
  std::vector<glm::vec3> normals(positions.size());
  // Faces back to back cancel up to rounding; what is left has no direction worth keeping.
  constexpr double kNothing = 1e-12;
  std::transform(sums.begin(), sums.end(), normals.begin(), [](const glm::dvec3& sum) {
    const double length = glm::length(sum);
    return length > kNothing ? glm::vec3(sum / length) : glm::vec3(0, 1, 0);
  });
  return normals;
}

}  // namespace lychnite
