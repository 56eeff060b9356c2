#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace lychnite::gpu {

struct ContextState;

/// What every GPU object shares: a driver's name that is given back exactly once, in the context that made it
/// (even when another context is current by then, or that context is gone), the bytes it holds there, and a
/// label for the debugger. Move-only. Made in the context current on the calling thread.
class Object {
 public:
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  const std::string& label() const { return label_; }
  /// Bytes this object holds on the device, as computed from its sizes.
  size_t bytes() const { return bytes_; }

 protected:
  using Deleter = void (*)(uint32_t id);
  /// `kind` is the OpenGL object type the label is given to; the label is set on the driver's object.
  Object(uint32_t id, uint32_t kind, Deleter deleter, std::string label);
  Object(Object&& other) noexcept;
  Object& operator=(Object&& other) noexcept;
  ~Object();

  void setBytes(size_t bytes);
  uint32_t id() const { return id_; }
  ContextState& state() const { return *state_; }

 private:
  friend struct ObjectAccess;  // lets the wrappers of gpu/ bind each other's objects
  void release() noexcept;

  std::shared_ptr<ContextState> state_;
  uint32_t id_ = 0;
  Deleter deleter_ = nullptr;
  size_t bytes_ = 0;
  std::string label_;
};

/// Bytes held by the buffers and textures of the context current on this thread.
size_t allocatedBytes();
/// The largest width or height of a texture here.
int maxTextureSize();
/// The most samples a multisampled texture can have here (at least 4).
int maxSamples();

}  // namespace lychnite::gpu
