#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lychnite/base/log.h"

namespace lychnite {

/// What the viewer remembers between runs.
struct Preferences {
  int windowWidth = 1280, windowHeight = 720;  ///< screen coordinates, 320 to 16384
  double panelWidth = 320;                     ///< at scale 1, 240 to 640
  bool ruler = true;
  int walkThreads = 0;              ///< 0 = one for two cores, half of them for more
  std::vector<std::string> recent;  ///< newest first, at most kMostRecent
  static constexpr size_t kMostRecent = 10;

  /// Puts `path` in front.
  void addRecent(const std::string& path);
  bool operator==(const Preferences&) const = default;
};

/// $XDG_CONFIG_HOME/lychnite, or ~/.config/lychnite; empty where neither is set.
std::filesystem::path configFolder();

/// The preferences of a file; defaults when there is none. A file that cannot be understood is renamed to
/// FILE.broken and `log` gets a warning; nothing is thrown.
Preferences readPreferences(const std::filesystem::path& path, const LogSink& log);
/// Makes the folder when needed. What cannot be written is a warning.
void writePreferences(const Preferences& preferences, const std::filesystem::path& path, const LogSink& log);

}  // namespace lychnite
