#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/object.h"

namespace lychnite::gpu {

enum class Format { kRgba8, kR16f, kRg16f, kRgba16f, kR32f, kRg32f, kRgba32f, kR32ui, kDepth32f };
enum class Filter { kNearest, kLinear, kNearestMipNearest, kLinearMipNearest, kLinearMipLinear };
enum class Wrap { kClampToEdge, kClampToBorder, kRepeat };

/// Channels of a texel (1, 2 or 4).
int channels(Format format);
/// Bytes of a texel on the device.
size_t texelBytes(Format format);
/// The driver's name of a format.
uint32_t internalFormat(Format format);
/// Levels of a full mip chain.
int fullLevels(int width, int height);

struct TextureDesc {
  std::string label{};
  Format format = Format::kRgba32f;
  int width = 1, height = 1;
  int levels = 1;   ///< 1 to fullLevels(); 0 means the full chain
  int samples = 1;  ///< above 1: multisampled (sampler2DMS), one level, no filter, wrap, upload or download
  Filter filter = Filter::kNearest;
  Wrap wrap = Wrap::kClampToEdge;
  std::array<float, 4> border{0, 0, 0, 0};  ///< used by kClampToBorder
};

class Texture;
/// The number by which a drawing library that is not ours knows the texture (a UI's images).
uint32_t foreignName(const Texture& texture);

/// A two-dimensional texture of fixed size and format. A one-dimensional table is one of height 1. Row 0 is
/// the lowest (v = 0). Throws Error (kUsage) when the device cannot hold the size asked for.
class Texture : public Object {
 public:
  explicit Texture(const TextureDesc& desc);

  const TextureDesc& desc() const { return desc_; }
  Format format() const { return desc_.format; }
  int width(int level = 0) const;
  int height(int level = 0) const;
  int levels() const { return desc_.levels; }

  void setFilter(Filter filter);
  void setWrap(Wrap wrap, const std::array<float, 4>& border = {0, 0, 0, 0});
  /// Fetches see only levels first..last; lets a pass read one level while it draws into another.
  void setLevelRange(int first, int last);

  /// Replaces a level: width * height * channels values, interleaved, row 0 first. Floats are converted to
  /// the texture's format (half floats are rounded by the driver).
  void upload(std::span<const float> values, int level = 0);
  /// The same for kR32ui.
  void upload(std::span<const uint32_t> values, int level = 0);
  /// Reads a level back in upload()'s layout (waits for the device).
  std::vector<float> download(int level = 0) const;
  /// The same for kR32ui.
  std::vector<uint32_t> downloadUint(int level = 0) const;
  /// Fills levels 1.. from level 0 by the driver's 2 x 2 means.
  void generateMipmaps();

 private:
  TextureDesc desc_;
};

}  // namespace lychnite::gpu
