#pragma once

#include <filesystem>
#include <string>

namespace lychnite {

/// The whole file as it is. Throws Error when it cannot be opened.
std::string readText(const std::filesystem::path& path);

}  // namespace lychnite
