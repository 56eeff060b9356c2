#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "lychnite/mesh/mesh.h"

namespace lychnite {

/// Faces of any number of corners, as files hold them: face i has `sizes[i]` of the `corners`, one after
/// another.
struct Polygons {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< none, or as many as positions
  std::vector<uint32_t> corners;
  std::vector<uint32_t> sizes;
};

/// Cuts the faces into triangles: by ear clipping, so that concave faces keep their shape (beyond 1024
/// corners, or when that takes too long, as a fan). Faces of one or two corners are dropped. Throws Error
/// naming `where` and the face when a corner points past the vertices.
Mesh triangulate(Polygons polygons, const std::string& where);

}  // namespace lychnite
