#include "lychnite/app/history.h"

#include <cassert>
#include <map>
#include <set>

namespace lychnite {

History::History(const ViewState& start) {
  steps_.push_back({start, fingerprint(start)});
}

void History::record(const ViewState& state) {
  std::string text = fingerprint(state);
  if (text == steps_[current_].fingerprint) return;
  steps_.resize(current_ + 1);
  steps_.push_back({state, std::move(text)});
  current_ = steps_.size() - 1;
  forget();
}

void History::forget() {
  std::set<const Mesh*> shown;
  for (const Object& object : steps_[current_].state.scene.objects) shown.insert(object.mesh.get());
  std::map<const Mesh*, size_t> uses;
  size_t bytes = 0;
  for (const Step& step : steps_)
    for (const Object& object : step.state.scene.objects)
      if (uses[object.mesh.get()]++ == 0 && !shown.contains(object.mesh.get()))
        bytes += object.mesh->memoryBytes();
  while (current_ > 0 && (steps_.size() > kMost || bytes > kMostMeshBytes)) {
    for (const Object& object : steps_.front().state.scene.objects)
      if (--uses[object.mesh.get()] == 0 && !shown.contains(object.mesh.get()))
        bytes -= object.mesh->memoryBytes();
    steps_.pop_front();
    --current_;
  }
}

const ViewState& History::undo() {
  assert(canUndo());
  return steps_[--current_].state;
}

const ViewState& History::redo() {
  assert(canRedo());
  return steps_[++current_].state;
}

}  // namespace lychnite
