#include "mesh/builtin/surface.h"

#include <glm/common.hpp>

namespace lychnite::builtin {

void Surface::addQuad(unsigned a, unsigned b, unsigned c, unsigned d) {
  triangles.emplace_back(a, b, c);
  triangles.emplace_back(a, c, d);
}

Mesh finishMesh(const Surface& surface) {
  Bounds bounds{surface.positions.front(), surface.positions.front()};
  for (const glm::dvec3& p : surface.positions) {
    bounds.min = glm::min(bounds.min, p);
    bounds.max = glm::max(bounds.max, p);
  }
  const glm::dvec3 centre = bounds.centre(), extent = bounds.extent();
  const double longest = glm::max(extent.x, glm::max(extent.y, extent.z));
  Mesh mesh;
  mesh.positions.reserve(surface.positions.size());
  for (const glm::dvec3& p : surface.positions) mesh.positions.emplace_back((p - centre) / longest);
  mesh.triangles = surface.triangles;
  mesh.normals = angleWeightedNormals(mesh.positions, mesh.triangles);
  return mesh;
}

}  // namespace lychnite::builtin
