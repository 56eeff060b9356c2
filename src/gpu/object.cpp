#include "gpu/object.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

#include "gpu/context_state.h"

namespace lychnite::gpu {

Object::Object(uint32_t id, uint32_t kind, Deleter deleter, std::string label)
    : state_(currentState()), id_(id), deleter_(deleter), label_(std::move(label)) {
  if (id_ == 0) return;  // the window's framebuffer, which is nobody's
  // 255 characters are what every driver takes.
  glObjectLabel(kind, id_, static_cast<GLsizei>(std::min<size_t>(label_.size(), 255)), label_.c_str());
}

Object::Object(Object&& other) noexcept
    : state_(std::move(other.state_)),
      id_(std::exchange(other.id_, 0)),
      deleter_(other.deleter_),
      bytes_(std::exchange(other.bytes_, 0)),
      label_(std::move(other.label_)) {}

Object& Object::operator=(Object&& other) noexcept {
  if (this == &other) return *this;
  release();
  state_ = std::move(other.state_);
  id_ = std::exchange(other.id_, 0);
  deleter_ = other.deleter_;
  bytes_ = std::exchange(other.bytes_, 0);
  label_ = std::move(other.label_);
  return *this;
}

Object::~Object() {
  release();
}

void Object::setBytes(size_t bytes) {
  state_->allocatedBytes += bytes;
  state_->allocatedBytes -= bytes_;
  bytes_ = bytes;
}

void Object::release() noexcept {
  if (!state_ || id_ == 0) return;
  setBytes(0);
  if (state_->alive) {
    const CurrentGuard guard(*state_);
    deleter_(id_);
  }
  id_ = 0;
}

}  // namespace lychnite::gpu
