#include "mesh/read/file_bytes.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "lychnite/base/error.h"

namespace lychnite {
namespace fs = std::filesystem;

void refuseUnlessFile(const fs::path& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::regular) return;
  std::string found = "a device or pipe";
  if (status.type() == fs::file_type::not_found) found = "no such file";
  if (status.type() == fs::file_type::directory) found = "a folder";
  if (status.type() == fs::file_type::none) found = code.message();
  throw Error({.where = path.string(), .expected = "a file", .found = found, .todo = "check the path"});
}

std::string readWholeFile(const fs::path& path) {
  refuseUnlessFile(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw Error({.where = path.string(),
                 .expected = "a readable file",
                 .found = std::strerror(errno),
                 .todo = "check its permissions"});
  std::error_code code;
  const std::uintmax_t size = fs::file_size(path, code);
  if (!code && size == 0)
    throw Error({.where = path.string(),
                 .expected = "a file with content",
                 .found = "an empty one",
                 .todo = "export or download it again"});
  std::string bytes(code ? 0 : size, '\0');
  if (code || !stream.read(bytes.data(), static_cast<std::streamsize>(size)))
    throw Error({.where = path.string(),
                 .expected = "a readable file",
                 .found = "an error while reading",
                 .todo = "check the disk"});
  return bytes;
}

}  // namespace lychnite
