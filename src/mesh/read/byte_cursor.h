#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include "lychnite/base/error.h"

namespace lychnite {

/// The one error of files that end too early.
[[noreturn]] inline void failTruncated(const std::string& where, const std::string& expected,
                                       size_t found_bytes) {
  throw Error({.where = where,
               .expected = expected,
               .found = std::to_string(found_bytes) + " bytes: it is truncated or its counts are wrong",
               .todo = "download or export it again"});
}

/// Reads values from bytes, never past their end.
class ByteCursor {
 public:
  ByteCursor(std::string_view bytes, std::endian order = std::endian::little)
      : bytes_(bytes), order_(order) {}

  size_t left() const { return bytes_.size(); }
  bool has(size_t count) const { return count <= bytes_.size(); }

  /// Takes `count` bytes; the caller has checked that they are there.
  std::string_view take(size_t count) {
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  /// Takes one value; the caller has checked that it is there.
  template <typename T>
  T value() {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), take(sizeof(T)).data(), sizeof(T));
    if (order_ != std::endian::native) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }

 private:
  std::string_view bytes_;
  std::endian order_;
};

}  // namespace lychnite
