#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lychnite/mesh/mesh.h"

namespace lychnite {

/// For every vertex the first vertex with the same position and, where `normals` is not empty, the same
/// normal. Equal means bit-identical, but -0 equals 0. Linear in time and memory.
std::vector<uint32_t> firstEquals(std::span<const glm::vec3> positions,
                                  std::span<const glm::vec3> normals = {});

struct EdgeFacts {
  size_t boundary = 0;      ///< edges of one triangle
  size_t non_manifold = 0;  ///< edges of more than two
  size_t misdirected = 0;   ///< edges of two triangles that run through it the same way
  bool closed() const { return boundary + non_manifold + misdirected == 0; }
};

/// Edges between the vertices `same[v]`; triangles with two equal corners have none.
EdgeFacts edgeFacts(const std::vector<glm::uvec3>& triangles, const std::vector<uint32_t>& same);

/// Twice the area times the unit normal, in double: for float corners zero exactly when the corners are in
/// line (up to the rounding of doubles).
glm::dvec3 areaVector(const Mesh& mesh, const glm::uvec3& triangle);

/// Volume by the divergence theorem, around the bounds' centre; negative when inside out.
double signedVolume(const Mesh& mesh, const Bounds& bounds);

}  // namespace lychnite
