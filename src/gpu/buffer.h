#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gpu/object.h"

namespace lychnite::gpu {

/// Linear device memory: vertices, indices, a uniform block or a shader's storage. Re-allocates only when the
/// size changes.
class Buffer : public Object {
 public:
  explicit Buffer(std::string label);

  /// Replaces the whole content (size included).
  template <class T>
  void upload(std::span<const T> values) {
    uploadBytes(std::as_bytes(values));
  }
  template <class T>
  void upload(const std::vector<T>& values) {
    upload(std::span<const T>(values));
  }
  /// Makes it `bytes` long, the content undefined, unless it is that long already.
  void resize(size_t bytes);
  /// Replaces bytes from `offset` (bytes) on; they must lie inside the buffer.
  void update(size_t offset, std::span<const std::byte> bytes);
  /// Reads everything back (waits for the device).
  std::vector<std::byte> download() const;

 private:
  void uploadBytes(std::span<const std::byte> bytes);
};

}  // namespace lychnite::gpu
