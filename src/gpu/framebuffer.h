#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/object.h"
#include "gpu/texture.h"

namespace lychnite::gpu {

/// One level of a texture to draw into.
struct Attachment {
  Attachment(const Texture& target, int targetLevel = 0) : texture(&target), level(targetLevel) {}  // NOLINT
  const Texture* texture;
  int level;
};

struct FramebufferDesc {
  std::string label{};
  std::vector<Attachment> colours{};  ///< output location i of the fragment shader is colours[i]
  std::optional<Attachment> depth{};
};

/// Where passes draw. The textures must outlive it (moving them is fine). Throws Error (kDevice) that names
/// the reason when the driver calls the combination incomplete.
class Framebuffer : public Object {
 public:
  explicit Framebuffer(const FramebufferDesc& desc);
  /// What the window shows after the next swap; `width` and `height` are its size in pixels now.
  static Framebuffer ofWindow(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  int colours() const { return colours_; }

  /// Whole-target clears; call them outside any pass.
  void clearColour(int index, const std::array<float, 4>& value);
  void clearColour(int index, uint32_t value);  ///< for kR32ui
  void clearDepth(float value = 1.0f);

  /// Copies colour `index` (averaging the samples of a multisampled source) into colour `targetIndex` of
  /// `target`, which must have the same size.
  void resolveColour(int index, Framebuffer& target, int targetIndex = 0) const;

  /// RGBA, 8 bits each, row 0 lowest (waits for the device). For 8-bit targets and windows.
  std::vector<uint8_t> readBytes() const;

 private:
  Framebuffer(int width, int height);

  int width_ = 0, height_ = 0, colours_ = 0;
};

}  // namespace lychnite::gpu
