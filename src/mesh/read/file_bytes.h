#pragma once

#include <filesystem>
#include <string>

namespace lychnite {

/// Throws Error for a missing file, a folder, a device or a pipe.
void refuseUnlessFile(const std::filesystem::path& path);

/// All of a regular file. Throws Error for a missing or unreadable one, a folder, a device, or an empty file.
std::string readWholeFile(const std::filesystem::path& path);

}  // namespace lychnite
