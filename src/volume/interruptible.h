#pragma once

#include "lychnite/base/progress.h"

namespace lychnite::volume {

/// While it lives, long work that is called on this thread asks its Progress now and then whether to go on,
/// and throws Interrupted when not. Work that runs on several threads asks where it runs on this one, which
/// ends it on all. Per thread and not handed down, because it concerns every loop and no result.
class Interruptible {
 public:
  /// Asks at once, with `step` as what is going on until this one ends.
  Interruptible(const Progress& progress, const Progress::Update& step);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  /// Called by the work; nothing where nobody listens.
  static void check();

 private:
  const Progress& progress_;
  Progress::Update step_;
  const Interruptible* outer_;
};

}  // namespace lychnite::volume
