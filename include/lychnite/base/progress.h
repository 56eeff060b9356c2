#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace lychnite {

/// Reports long work to the caller and asks whether to go on. Copyable; an empty one is silent and never
/// stops. Called from one thread at a time by the library.
class Progress {
 public:
  struct Update {
    std::string_view what;  ///< e.g. "walk"
    double fraction = 0;    ///< 0..1
    std::string detail;     ///< e.g. "12/64 samples, noise 3.1 %"
  };
  /// Returns false to stop the work.
  using Function = std::function<bool(const Update&)>;

  Progress() = default;
  explicit Progress(Function function) : function_(std::move(function)) {}

  /// Reports; returns false when the caller wants to stop. For work that can save what it has.
  bool update(const Update& update) const { return !function_ || function_(update); }
  /// Reports; throws Interrupted when the caller wants to stop. For work that has nothing to save.
  void check(const Update& update) const;

 private:
  Function function_;
};

}  // namespace lychnite
