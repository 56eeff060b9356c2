#pragma once

#include <stdexcept>
#include <string>

namespace lychnite {

/// The one exception type of the library: a bad input, file, shader or device (never a programmer's mistake,
/// which asserts). Only front ends turn it into exit codes or dialogs.
///
/// what() is one line, "where: expected ..., found ...; to do", with empty parts left out.
class Error : public std::runtime_error {
 public:
  /// Whose business the failure is; the command line maps it to its exit status (1, 2, 3).
  enum class Kind { kInput, kUsage, kDevice };

  struct Parts {
    std::string where;     ///< path, "path:line", flag or TOML key
    std::string expected;  ///< what would have been right, e.g. "a length with a unit (20mm, 3cm, 1in)"
    std::string found;     ///< what was there instead, e.g. "'20'"
    std::string todo;      ///< what the user can do about it
  };

  explicit Error(Parts parts, Kind kind = Kind::kInput);

  const Parts& parts() const { return parts_; }
  Kind kind() const { return kind_; }

 private:
  Parts parts_;
  Kind kind_;
};

/// Thrown when the user's interrupt (Progress::update returning false) stops long work.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace lychnite
