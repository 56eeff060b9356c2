#pragma once

#include <filesystem>

namespace lychnite {

/// Walks an EXR file's attributes before OpenEXR allocates what they claim. Throws Error when one reaches
/// past the end of the file, when the window or the tiles are out of proportion, or for multi-part and deep
/// files.
void checkExrHeader(const std::filesystem::path& path);

}  // namespace lychnite
