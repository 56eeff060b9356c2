#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "gpu/egl.h"
#include "lychnite/base/log.h"

namespace lychnite::gpu {

/// What a Context shares with the objects made in it. Outlives the Context as long as one of them is left.
struct ContextState {
  EglContext egl;
  bool alive = true;  ///< false once the driver's context is gone, and its objects with it
  bool debug = false;
  LogSink log;
  size_t allocatedBytes = 0;
  int maxTextureSize = 0, maxSamples = 0;
  uint32_t emptyVertexArray = 0;  ///< what core profile wants bound for draws without attributes
  bool inPass = false;
  bool timerRunning = false;
  std::string firstError;  ///< of KHR_debug, since the last check
};

/// Makes a context current for a while, and what was current before afterwards. Costs nothing when it is
/// already.
class CurrentGuard {
 public:
  explicit CurrentGuard(const ContextState& state);
  ~CurrentGuard();
  CurrentGuard(const CurrentGuard&) = delete;
  CurrentGuard& operator=(const CurrentGuard&) = delete;

 private:
  std::unique_ptr<CurrentKeeper> before_;
};

/// The state of the Context current on this thread; asserts that there is one.
const std::shared_ptr<ContextState>& currentState();

/// The error text since the last call, "" when there was none. The state's context must be current.
std::string takeError(ContextState& state);

}  // namespace lychnite::gpu
