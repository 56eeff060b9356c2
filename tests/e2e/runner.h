#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lychnite/image/image.h"

namespace lychnite::e2e {

/// How a run of the program ended. `status` is what a shell would show: the exit status, or 128 + signal.
struct Result {
  int status = -1;
  std::string out, err;
  size_t peakBytes = 0;  ///< the most memory it had resident
};

/// Environment variables to set for one run; an empty value removes the variable.
using Environment = std::map<std::string, std::string>;

/// A folder of the running test's own, empty at first and removed at the end. The program runs in it, so that
/// relative names in arguments mean files of this folder.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  /// Names of what lies in the folder, hidden files (and so the temporaries of half-written ones) included.
  std::set<std::string> names() const;
  void write(const std::string& name, std::string_view text) const;
  std::string read(const std::string& name) const;

  /// Runs `lychnite` to its end.
  Result run(const std::vector<std::string>& arguments, const Environment& environment = {}) const;
  /// Runs it and tells `look` every second how many bytes it has resident now.
  Result watch(const std::vector<std::string>& arguments, const Environment& environment,
               const std::function<void(size_t residentBytes)>& look) const;
  /// Starts `lychnite`, sends SIGINT `seconds` after it began to listen to it, waits for its end.
  Result runAndInterrupt(const std::vector<std::string>& arguments, double seconds) const;

 private:
  int start(const std::vector<std::string>& arguments, const Environment& environment) const;
  Result finish(int pid) const;

  std::filesystem::path folder_, captured_;
};

/// Fails the test unless the run ended with `status` and said on stderr exactly one line that holds `words`.
void expectOneLine(const Result& result, int status, const std::string& words);

/// `render MODEL` at 64 x 64 with a small map and a quick method, then `more`; nothing is written unless
/// `more` says -o.
std::vector<std::string> renderArguments(const std::string& model, const std::vector<std::string>& more);

/// Root mean square of the difference over that of `b`, of the colour of all pixels.
double relativeDifference(const Image& a, const Image& b);

}  // namespace lychnite::e2e
