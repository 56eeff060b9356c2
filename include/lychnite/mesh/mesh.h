#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace lychnite {

struct Bounds {
  glm::dvec3 min{0}, max{0};
  glm::dvec3 centre() const { return 0.5 * (min + max); }
  glm::dvec3 extent() const { return max - min; }
  double longestSide() const;
};

/// The box of a mesh, and the radius about the box's centre that holds it.
struct Extent {
  Bounds bounds;
  double radius = 0;
};

/// A triangle mesh in its own units (a file's units mean nothing until an object is given its true size).
/// Counter-clockwise triangles face outwards. Normals are unit, per vertex, as many as positions.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::uvec3> triangles;
  /// extentOf()'s answer, kept because every frame asks for it; positions must not change afterwards.
  std::optional<Extent> extent;

  size_t memoryBytes() const;
};

/// A point of a mesh: barycentric weights of a triangle's second and third corner.
struct MeshPoint {
  uint32_t triangle = 0;
  float u = 0, v = 0;
};

Bounds boundsOf(const Mesh& mesh);

/// The kept extent, or a fresh look at all positions. Loaders and built-in models keep theirs.
Extent extentOf(const Mesh& mesh);

/// Angle-weighted vertex normals (Thurmer & Wuthrich 1998). Vertices of no area get +y.
std::vector<glm::vec3> angleWeightedNormals(const std::vector<glm::vec3>& positions,
                                            const std::vector<glm::uvec3>& triangles);

}  // namespace lychnite
