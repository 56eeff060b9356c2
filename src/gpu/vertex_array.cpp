#include "gpu/vertex_array.h"

#include <epoxy/gl.h>

#include "gpu/object_access.h"

namespace lychnite::gpu {
namespace {

uint32_t createVertexArray() {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  return id;
}

void deleteVertexArray(uint32_t id) {
  glDeleteVertexArrays(1, &id);
}

void addAttribute(uint32_t array, uint32_t attribute, const Buffer& buffer) {
  glVertexArrayVertexBuffer(array, attribute, ObjectAccess::id(buffer), 0, sizeof(glm::vec3));
  glVertexArrayAttribFormat(array, attribute, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(array, attribute, attribute);
  glEnableVertexArrayAttrib(array, attribute);
}

}  // namespace

VertexArray::VertexArray(const std::string& label)
    : Object(createVertexArray(), GL_VERTEX_ARRAY, deleteVertexArray, label),
      positions_(label + " positions"),
      normals_(label + " normals"),
      indices_(label + " triangles") {
  addAttribute(id(), 0, positions_);
  addAttribute(id(), 1, normals_);
  glVertexArrayElementBuffer(id(), ObjectAccess::id(indices_));
}

void VertexArray::setPositions(std::span<const glm::vec3> positions) {
  positions_.upload(positions);
}

void VertexArray::setNormals(std::span<const glm::vec3> normals) {
  normals_.upload(normals);
}

void VertexArray::setTriangles(std::span<const glm::uvec3> triangles) {
  indices_.upload(triangles);
  triangles_ = triangles.size();
}

}  // namespace lychnite::gpu
