#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "gpu/buffer.h"
#include "gpu/object.h"

namespace lychnite::gpu {

/// An indexed triangle mesh on the device. Attribute 0 is the position (vec3), attribute 1 the normal (vec3).
/// Positions, normals and triangles can be replaced one by one.
class VertexArray : public Object {
 public:
  explicit VertexArray(const std::string& label);

  void setPositions(std::span<const glm::vec3> positions);
  void setNormals(std::span<const glm::vec3> normals);
  /// Counter-clockwise from outside; indices must lie below the number of positions.
  void setTriangles(std::span<const glm::uvec3> triangles);

  size_t triangles() const { return triangles_; }
  /// The buffers' bytes.
  size_t bytes() const { return positions_.bytes() + normals_.bytes() + indices_.bytes(); }

 private:
  Buffer positions_, normals_, indices_;
  size_t triangles_ = 0;
};

}  // namespace lychnite::gpu
