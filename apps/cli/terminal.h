#pragma once

#include "lychnite/base/log.h"
#include "lychnite/base/progress.h"

namespace lychnite::cli {

/// A progress bar on stderr (what, how much, time left) when that is a terminal, nothing in a pipe. Asks the
/// work to stop after the first SIGINT or SIGTERM; a second one ends the program at once.
Progress terminalProgress();

/// True once the user asked to stop.
bool wasInterrupted();

/// Ends the line that a progress bar is on, if any.
void finishProgress();

/// Warnings (and with `verbose` everything else) to stderr.
LogSink terminalLog(bool verbose);

}  // namespace lychnite::cli
