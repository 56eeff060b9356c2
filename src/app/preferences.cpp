#include "lychnite/app/preferences.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "lychnite/base/atomic_file.h"
#include "lychnite/base/error.h"
#include "lychnite/base/text.h"

namespace lychnite {
namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& path, std::string expected) {
  throw Error({.where = path.string(), .expected = std::move(expected), .found = "another", .todo = ""});
}

template <class T>
void read(const toml::table& table, const fs::path& path, const char* key, T& value, T least, T most) {
  const toml::node_view node = table[key];
  if (!node) return;
  const auto number = node.value<double>();
  if (!number || !(*number >= double(least) && *number <= double(most)))
    refuse(path, fmt::format("{} from {} to {}", key, least, most));
  value = T(*number);
}

Preferences parse(const fs::path& path) {
  const toml::table table = toml::parse_file(path.string());
  Preferences result;
  read(table, path, "window_width", result.windowWidth, 320, 16384);
  read(table, path, "window_height", result.windowHeight, 240, 16384);
  read(table, path, "panel_width", result.panelWidth, 240.0, 640.0);
  read(table, path, "walk_threads", result.walkThreads, 0, 1024);
  if (const toml::node_view ruler = table["ruler"]) {
    if (!ruler.is_boolean()) refuse(path, "ruler = true or false");
    result.ruler = ruler.value_or(true);
  }
  if (const toml::node_view recent = table["recent"]) {
    if (!recent.is_array()) refuse(path, "recent = a list of files");
    for (const toml::node& node : *recent.as_array())
      if (const auto text = node.value<std::string>();
          text && result.recent.size() < Preferences::kMostRecent)
        result.recent.push_back(*text);
  }
  return result;
}

}  // namespace

void Preferences::addRecent(const std::string& path) {
  std::erase(recent, path);
  recent.insert(recent.begin(), path);
  if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

fs::path configFolder() {
  const char* base = std::getenv("XDG_CONFIG_HOME");
  if (base && fs::path(base).is_absolute()) return fs::path(base) / "lychnite";
  const char* home = std::getenv("HOME");
  if (home && *home) return fs::path(home) / ".config" / "lychnite";
  return {};
}

Preferences readPreferences(const fs::path& path, const LogSink& log) {
  std::error_code code;
  if (path.empty() || !fs::exists(path, code)) return {};
  std::string problem;
  try {
    return parse(path);
  } catch (const toml::parse_error& error) {
    problem = fmt::format("line {}: {}", error.source().begin.line, error.description());
  } catch (const std::exception& error) {
    problem = error.what();
  }
  const fs::path aside = path.string() + ".broken";
  fs::rename(path, aside, code);
  logTo(log, LogLevel::kWarning,
        fmt::format("The settings could not be read ({}); {}", problem,
                    code ? "defaults are used" : "they were set aside as " + aside.string()));
  return {};
}

void writePreferences(const Preferences& preferences, const fs::path& path, const LogSink& log) {
  if (path.empty()) return;
  const Preferences& p = preferences;
  std::string text = fmt::format(
      "window_width = {}\nwindow_height = {}\npanel_width = {}\nruler = {}\nwalk_threads = {}\nrecent = [",
      p.windowWidth, p.windowHeight, p.panelWidth, p.ruler, p.walkThreads);
  for (const std::string& file : p.recent) text += "\n  " + tomlString(file) + ",";
  text += "\n]\n";
  try {
    fs::create_directories(path.parent_path());
    writeTextAtomically(path, text);
  } catch (const std::exception& error) {
    logTo(log, LogLevel::kWarning, fmt::format("The settings were not kept: {}", error.what()));
  }
}

}  // namespace lychnite
