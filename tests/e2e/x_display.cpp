#include "e2e/x_display.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <utility>

extern char** environ;

namespace lychnite::e2e {

std::optional<XDisplay> XDisplay::start(int width, int height) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return {};
  // The server chooses a free number itself and writes it when it is ready.
  std::string screen = std::to_string(width) + "x" + std::to_string(height) + "x24",
              number = std::to_string(ends[1]);
  std::array<std::string, 9> words{"Xvfb", "-displayfd", number, "-screen", "0",
                                   screen, "-nolisten",  "tcp",  "-noreset"};
  std::array<char*, 10> arguments{};
  for (size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t pid = 0;
  const int failed = posix_spawnp(&pid, "Xvfb", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::string name;
  char c = 0;
  while (!failed && read(ends[0], &c, 1) == 1 && c != '\n') name += c;
  close(ends[0]);
  if (failed) return {};
  if (name.empty()) {
    waitpid(pid, nullptr, 0);
    return {};
  }
  return XDisplay(pid, ":" + name);
}

XDisplay::XDisplay(XDisplay&& other) noexcept
    : pid_(std::exchange(other.pid_, 0)), name_(std::move(other.name_)) {}

XDisplay::~XDisplay() {
  if (pid_ == 0) return;
  kill(pid_, SIGTERM);
  waitpid(pid_, nullptr, 0);
}

}  // namespace lychnite::e2e
