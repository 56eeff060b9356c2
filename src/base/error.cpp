#include "lychnite/base/error.h"

#include <utility>

#include "lychnite/base/progress.h"

namespace lychnite {
namespace {

std::string oneLine(const Error::Parts& parts) {
  std::string line = parts.where;
  const auto append = [&line](const std::string& text, const char* separator, const char* prefix) {
    if (text.empty()) return;
    if (!line.empty()) line += separator;
    line += prefix + text;
  };
  append(parts.expected, ": ", "expected ");
  append(parts.found, parts.expected.empty() ? ": " : ", ", parts.expected.empty() ? "" : "found ");
  append(parts.todo, "; ", "");
  for (char& c : line)
    if (c == '\n' || c == '\r') c = ' ';
  return line;
}

}  // namespace

Error::Error(Parts parts, Kind kind)
    : std::runtime_error(oneLine(parts)), parts_(std::move(parts)), kind_(kind) {}

void Progress::check(const Update& u) const {
  if (!update(u)) throw Interrupted();
}

}  // namespace lychnite
