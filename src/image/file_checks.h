#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "lychnite/image/image.h"

namespace lychnite {

constexpr int kMaxImageSide = 16384;

/// Throws Error unless both sides are 1 to kMaxImageSide and the decoded floats stay in proportion to the
/// file's size, so that a few bytes cannot claim gigabytes.
void checkImageClaim(const std::filesystem::path& path, int64_t width, int64_t height, int64_t channels);

/// Throws Error for a picture without pixels, and for metadata that EXR or PNG could not hold: keys are 1 to
/// 79 printable ASCII characters without blanks at the ends or in a row, values are free of NUL.
void checkWritable(const Image& image, const std::filesystem::path& path);

/// Library messages often span lines; an Error's parts must not.
std::string oneLine(std::string text);

Image readExr(const std::filesystem::path& path);
Image readPng(const std::filesystem::path& path);

}  // namespace lychnite
