#include "lychnite/base/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <system_error>

#include "lychnite/base/error.h"

namespace lychnite {
namespace fs = std::filesystem;

namespace {

/// A name beside `path` that no other thread or process uses; keeps the extension, which some writers look
/// at.
fs::path temporaryBeside(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  return path.parent_path() / fmt::format(".{}.{}-{}.part{}", path.stem().string(), ::getpid(), counter++,
                                          path.extension().string());
}

void refuseFolderProblems(const fs::path& path) {
  std::error_code code;
  // Renaming onto a device or a pipe would replace it.
  if (fs::exists(path, code) && !fs::is_regular_file(path, code))
    throw Error({.where = path.string(),
                 .expected = "a file name to write to",
                 .found = fs::is_directory(path, code) ? "a folder" : "something that is not a plain file",
                 .todo = ""});
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, code))
    throw Error({.where = path.string(),
                 .expected = "",
                 .found = fmt::format("there is no folder '{}'", folder.string()),
                 .todo = "make it first"});
}

}  // namespace

void writeAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  refuseFolderProblems(path);
  const fs::path temporary = temporaryBeside(path);
  std::error_code ignored;
  try {
    write(temporary);
    std::error_code code;
    fs::rename(temporary, path, code);
    if (code)
      throw Error(
          {.where = path.string(), .expected = "", .found = "cannot write: " + code.message(), .todo = ""});
  } catch (const Error& error) {
    fs::remove(temporary, ignored);
    if (error.parts().where != temporary.string()) throw;
    Error::Parts parts = error.parts();
    parts.where = path.string();
    throw Error(parts, error.kind());
  } catch (...) {
    fs::remove(temporary, ignored);
    throw;
  }
}

void writeTextAtomically(const fs::path& path, std::string_view text) {
  writeAtomically(path, [&](const fs::path& temporary) {
    std::ofstream file(temporary, std::ios::binary);
    file.write(text.data(), std::streamsize(text.size()));
    file.close();
    if (!file)
      throw Error({.where = path.string(),
                   .expected = "",
                   .found = "cannot write",
                   .todo = "check the folder's permissions and the free space"});
  });
}

}  // namespace lychnite
