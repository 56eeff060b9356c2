#pragma once

#include <filesystem>

#include "lychnite/image/image.h"
#include "lychnite/image/tone_map.h"

namespace lychnite {

/// Writes every channel as 32-bit float with the metadata as string attributes; whole or not at all. Throws Error.
void writeExr(const Image& image, const std::filesystem::path& path);

struct PngOptions {
  ToneMapping toneMapping;
  int bits = 8;          ///< 8 or 16
  bool alpha = false;    ///< also write A (straight alpha)
};
/// Writes the main picture through the tone mapping; whole or not at all. Metadata become tEXt chunks.
void writePng(const Image& image, const std::filesystem::path& path, const PngOptions& options = {});

/// Reads an EXR (all channels) or PNG (8/16 bit; sRGB is undone to linear) by its content. Throws Error for
/// anything else, a truncated file, or one above 16384 x 16384.
Image readImage(const std::filesystem::path& path);

}  // namespace lychnite
