#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace lychnite {

/// Makes `path` appear whole or not at all: calls `write` with a temporary name in the same folder, then
/// renames it to `path`. When `write` throws or the rename fails, the temporary file is removed and Error is
/// thrown.
void writeAtomically(const std::filesystem::path& path,
                     const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same for text that is already there.
void writeTextAtomically(const std::filesystem::path& path, std::string_view text);

}  // namespace lychnite
