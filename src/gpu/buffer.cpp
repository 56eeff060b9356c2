#include "gpu/buffer.h"

#include <epoxy/gl.h>

#include <cassert>
#include <utility>

namespace lychnite::gpu {
namespace {

uint32_t createBuffer() {
  GLuint id = 0;
  glCreateBuffers(1, &id);
  return id;
}

void deleteBuffer(uint32_t id) {
  glDeleteBuffers(1, &id);
}

}  // namespace

Buffer::Buffer(std::string label) : Object(createBuffer(), GL_BUFFER, deleteBuffer, std::move(label)) {}

void Buffer::uploadBytes(std::span<const std::byte> content) {
  if (content.size() == bytes() && !content.empty()) return update(0, content);
  glNamedBufferData(id(), static_cast<GLsizeiptr>(content.size()), content.data(), GL_DYNAMIC_DRAW);
  setBytes(content.size());
}

void Buffer::resize(size_t size) {
  if (size == bytes()) return;
  glNamedBufferData(id(), static_cast<GLsizeiptr>(size), nullptr, GL_DYNAMIC_COPY);
  setBytes(size);
}

void Buffer::update(size_t offset, std::span<const std::byte> content) {
  assert(offset + content.size() <= bytes());
  glNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(content.size()),
                       content.data());
}

std::vector<std::byte> Buffer::download() const {
  std::vector<std::byte> content(bytes());
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);  // what shaders wrote
  if (!content.empty())
    glGetNamedBufferSubData(id(), 0, static_cast<GLsizeiptr>(content.size()), content.data());
  return content;
}

}  // namespace lychnite::gpu
