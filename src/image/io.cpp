#include "lychnite/image/io.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "image/file_checks.h"
#include "lychnite/base/error.h"

namespace lychnite {
namespace fs = std::filesystem;

namespace {

// Deflate cannot expand more than 1032:1 and the other EXR codecs stay near that; beyond it a size is a lie.
constexpr int64_t kMaxExpansion = 4096;
constexpr int64_t kAlwaysAllowedBytes = int64_t(16) << 20;

void refuseUnreadable(const fs::path& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  std::string found;
  if (!fs::exists(status))
    found = "no such file";
  else if (fs::is_directory(status))
    found = "a folder";
  else if (!fs::is_regular_file(status))
    found = "something that is not a plain file";
  else if (fs::file_size(path, code) == 0)
    found = "an empty file";
  if (!found.empty())
    throw Error({.where = path.string(), .expected = "an EXR or PNG picture", .found = found, .todo = ""});
}

bool validKey(const std::string& key) {
  if (key.empty() || key.size() > 79 || key.front() == ' ' || key.back() == ' ') return false;
  if (key.find("  ") != std::string::npos) return false;
  return std::all_of(key.begin(), key.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

}  // namespace

void checkImageClaim(const fs::path& path, int64_t width, int64_t height, int64_t channels) {
  if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide)
    throw Error({.where = path.string(),
                 .expected = fmt::format("a picture of 1 x 1 to {0} x {0} pixels", kMaxImageSide),
                 .found = fmt::format("{} x {}", width, height),
                 .todo = ""});
  std::error_code code;
  const auto fileBytes = int64_t(std::min<std::uintmax_t>(fs::file_size(path, code), uint64_t(1) << 50));
  const int64_t pictureBytes = width * height * int64_t(sizeof(float));
  const int64_t allowed = std::max(kAlwaysAllowedBytes, kMaxExpansion * fileBytes);
  if (channels > allowed / pictureBytes)
    throw Error({.where = path.string(),
                 .expected = "a whole picture",
                 .found = fmt::format("{} x {} pixels of {} channels claimed by {} bytes", width, height,
                                      channels, fileBytes),
                 .todo = "the file is truncated or damaged; write it again"});
}

void checkWritable(const Image& image, const fs::path& path) {
  if (image.empty() || image.channels().empty())
    throw Error({.where = path.string(),
                 .expected = "a picture to write",
                 .found = "one without pixels",
                 .todo = ""});
  for (const auto& [key, value] : image.metadata) {
    if (!validKey(key))
      throw Error({.where = path.string(),
                   .expected = "metadata names of 1 to 79 printable ASCII characters",
                   .found = fmt::format("'{}'", oneLine(key)),
                   .todo = ""});
    if (value.find('\0') != std::string::npos)
      throw Error({.where = path.string(),
                   .expected = "metadata without NUL characters",
                   .found = fmt::format("one in '{}'", key),
                   .todo = ""});
  }
}

std::string oneLine(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32) c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

Image readImage(const fs::path& path) {
  refuseUnreadable(path);
  char magic[8] = {};
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Error(
        {.where = path.string(), .expected = "", .found = "cannot read", .todo = "check its permissions"});
  file.read(magic, sizeof magic);
  file.close();
  const std::string_view start(magic, sizeof magic);
  if (start.starts_with("\x76\x2f\x31\x01")) return readExr(path);
  if (start == std::string_view("\x89PNG\r\n\x1a\n", 8)) return readPng(path);
  throw Error({.where = path.string(),
               .expected = "an EXR or PNG picture",
               .found = "a file that starts like neither",
               .todo = ""});
}

}  // namespace lychnite
