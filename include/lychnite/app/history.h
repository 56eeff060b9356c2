#pragma once

#include <deque>
#include <string>

#include "lychnite/app/view_state.h"

namespace lychnite {

/// The states one can go back to. Bounded: the oldest are forgotten above `kMost` steps, and while the meshes
/// that only the past still uses hold more than `kMostMeshBytes`.
class History {
 public:
  static constexpr size_t kMost = 500, kMostMeshBytes = size_t(512) << 20;

  explicit History(const ViewState& start);

  /// A new step after the current one, which drops what was undone. Nothing when `state` equals it.
  void record(const ViewState& state);
  bool canUndo() const { return current_ > 0; }
  bool canRedo() const { return current_ + 1 < steps_.size(); }
  /// One step; canUndo() (canRedo()) must hold.
  const ViewState& undo();
  const ViewState& redo();
  size_t size() const { return steps_.size(); }

 private:
  struct Step {
    ViewState state;
    std::string fingerprint;
  };
  void forget();

  std::deque<Step> steps_;
  size_t current_ = 0;
};

}  // namespace lychnite
