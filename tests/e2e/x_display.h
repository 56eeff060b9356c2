#pragma once

#include <optional>
#include <string>

namespace lychnite::e2e {

/// An X server without a screen (Xvfb) of the running test's own.
class XDisplay {
 public:
  /// Nothing where Xvfb is not installed.
  static std::optional<XDisplay> start(int width, int height);
  ~XDisplay();
  XDisplay(XDisplay&& other) noexcept;
  XDisplay& operator=(XDisplay&&) = delete;

  /// ":7", for DISPLAY.
  const std::string& name() const { return name_; }

 private:
  XDisplay(int pid, std::string name) : pid_(pid), name_(std::move(name)) {}
  int pid_ = 0;
  std::string name_;
};

}  // namespace lychnite::e2e
