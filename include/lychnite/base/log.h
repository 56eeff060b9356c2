#pragma once

#include <functional>
#include <string_view>

namespace lychnite {

enum class LogLevel { kDebug, kInfo, kWarning };

/// Where the library's messages go: the caller's function, never stdout. An empty sink is silence.
using LogSink = std::function<void(LogLevel, std::string_view)>;

inline void logTo(const LogSink& sink, LogLevel level, std::string_view message) {
  if (sink) sink(level, message);
}

}  // namespace lychnite
