#include "image/exr_header.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <string>

#include "image/file_checks.h"
#include "lychnite/base/error.h"

namespace lychnite {
namespace fs = std::filesystem;

namespace {

constexpr uint32_t kNonImageFlag = 0x800, kMultiPartFlag = 0x1000;
constexpr size_t kLongestName = 255;

class HeaderWalk {
 public:
  explicit HeaderWalk(const fs::path& path)
      : path_(path), file_(path, std::ios::binary), left_(int64_t(fs::file_size(path))) {}

  void run() {
    int32();  // the magic number, known to be right
    const uint32_t version = uint32_t(int32());
    if (version & (kNonImageFlag | kMultiPartFlag))
      throw Error({.where = path_.string(),
                   .expected = "an EXR file of one flat picture",
                   .found = version & kMultiPartFlag ? "several parts" : "deep data",
                   .todo = "write the parts as separate files"});
    while (attribute()) {
    }
  }

 private:
  [[noreturn]] void damaged(const std::string& found) const {
    throw Error({.where = path_.string(),
                 .expected = "a whole EXR picture",
                 .found = found,
                 .todo = "the file is truncated or damaged; write it again"});
  }

  void take(char* bytes, int64_t count) {
    if (count > left_ || !file_.read(bytes, count)) damaged("an end within the header");
    left_ -= count;
  }

  int32_t int32() {
    unsigned char raw[4] = {};
    take(reinterpret_cast<char*>(raw), 4);
    return int32_t(raw[0] | uint32_t(raw[1]) << 8 | uint32_t(raw[2]) << 16 | uint32_t(raw[3]) << 24);
  }

  std::string name() {
    std::string text;
    for (char c = 0; take(&c, 1), c != 0; text += c)
      if (text.size() == kLongestName) damaged("an attribute name without end");
    return text;
  }

  bool attribute() {
    const std::string key = name();
    if (key.empty()) return false;
    const std::string type = name();
    const int64_t size = int32();
    if (size < 0 || size > left_) damaged("attribute '" + oneLine(key) + "' longer than the file");
    if (key == "dataWindow")
      window(size);
    else if (key == "tiles")
      tiles(size);
    else if (type == "preview")
      preview(size);
    else
      skip(size);
    return true;
  }

  void skip(int64_t count) {
    file_.seekg(count, std::ios::cur);
    left_ -= count;
  }

  void expectSize(int64_t size, int64_t expected, const char* key) const {
    if (size != expected) damaged(std::string("attribute '") + key + "' of the wrong length");
  }

  void window(int64_t size) {
    expectSize(size, 16, "dataWindow");
    std::array<int64_t, 4> corners;
    for (int64_t& corner : corners) corner = int32();
    checkImageClaim(path_, corners[2] - corners[0] + 1, corners[3] - corners[1] + 1, 1);
  }

  void tiles(int64_t size) {
    expectSize(size, 9, "tiles");
    const auto width = uint32_t(int32()), height = uint32_t(int32());
    skip(1);
    checkImageClaim(path_, width, height, 1);
  }

  void preview(int64_t size) {
    if (size < 8) damaged("a preview without a size");
    const auto width = uint32_t(int32()), height = uint32_t(int32());
    if (width > uint32_t(kMaxImageSide) || height > uint32_t(kMaxImageSide) ||
        int64_t(width) * int64_t(height) * 4 != size - 8)
      damaged("a preview of another size than it says");
    skip(size - 8);
  }

  const fs::path& path_;
  std::ifstream file_;
  int64_t left_;
};

}  // namespace

void checkExrHeader(const fs::path& path) {
  HeaderWalk(path).run();
}

}  // namespace lychnite
