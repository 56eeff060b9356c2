#pragma once

#include <filesystem>

#include "lychnite/image/image.h"
#include "lychnite/image/tone_map.h"

namespace lychnite {

/// Writes every channel as 32-bit float (ZIP) with the metadata as string attributes; whole or not at all.
/// Metadata names go in unchanged: 1 to 79 printable ASCII characters, and not one that EXR uses itself
/// ("channels", "type", ...). Throws Error for other names, an image without pixels, or when it cannot write.
void writeExr(const Image& image, const std::filesystem::path& path);

struct PngOptions {
  ToneMapping toneMapping;
  int bits = 8;        ///< 8 or 16
  bool alpha = false;  ///< also write A (straight alpha)
};
/// Writes the main picture through the tone mapping; whole or not at all. Metadata (names as for EXR) become
/// tEXt chunks, or iTXt where the value is not ASCII. Throws Error as writeExr does, and for other bit
/// counts.
void writePng(const Image& image, const std::filesystem::path& path, const PngOptions& options = {});

/// Reads an EXR or a PNG, told apart by content. EXR: one flat part; every channel (half and integer too) of
/// the data window, wherever that lies; string attributes become metadata. PNG: grey, palette or RGB of up to
/// 16 bits becomes linear R, G, B (taken as sRGB, other gamma chunks ignored), transparency becomes A, texts
/// metadata. Throws Error for anything else, a truncated or damaged file, or one above 16384 x 16384; what it
/// allocates is bounded by the size of the file.
Image readImage(const std::filesystem::path& path);

}  // namespace lychnite
