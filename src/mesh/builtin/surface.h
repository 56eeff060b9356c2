#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "lychnite/mesh/mesh.h"

namespace lychnite::builtin {

/// A triangle surface in double precision while it is being made.
struct Surface {
  std::vector<glm::dvec3> positions;
  std::vector<glm::uvec3> triangles;

  /// Appends the two triangles of the quad a b c d (counter-clockwise from outside).
  void addQuad(unsigned a, unsigned b, unsigned c, unsigned d);
};

/// Centres the surface, scales its longest side to 1, rounds to float and gives it angle-weighted normals.
Mesh finishMesh(const Surface& surface);

}  // namespace lychnite::builtin
