#include "terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>

namespace lychnite::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;
bool lineOpen = false;

void onSignal(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

std::string timeText(double seconds) {
  const long s = long(seconds + 0.5);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{}:{:02} min", s / 60, s % 60);
  return fmt::format("{}:{:02} h", s / 3600, s / 60 % 60);
}

}  // namespace

bool wasInterrupted() {
  return interrupted != 0;
}

void finishProgress() {
  if (lineOpen) std::fputs("\r\033[K", stderr);
  lineOpen = false;
}

Progress terminalProgress() {
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  using Clock = std::chrono::steady_clock;
  const bool terminal = isatty(fileno(stderr)) != 0;
  return Progress(
      [terminal, start = Clock::now(), last = Clock::time_point()](const Progress::Update& update) mutable {
        const auto now = Clock::now();
        const double elapsed = std::chrono::duration<double>(now - start).count();
        if (update.fraction <= 0) start = now;
        if (terminal && elapsed > 0.3 && now - last > std::chrono::milliseconds(100)) {
          last = now;
          const int filled = int(update.fraction * 24);
          std::string line =
              fmt::format("\r\033[K{} [{}{}] {:3.0f} %", update.what, std::string(size_t(filled), '#'),
                          std::string(size_t(24 - filled), '.'), update.fraction * 100);
          if (!update.detail.empty()) line += "  " + update.detail;
          if (update.fraction > 0.01) line += "  " + timeText(elapsed * (1 / update.fraction - 1)) + " left";
          std::fputs(line.c_str(), stderr);
          lineOpen = true;
        }
        return interrupted == 0;
      });
}

LogSink terminalLog(bool verbose) {
  return [verbose](LogLevel level, std::string_view message) {
    if (level != LogLevel::kWarning && !verbose) return;
    finishProgress();
    fmt::print(stderr, "lychnite: {}{}\n", level == LogLevel::kWarning ? "warning: " : "", message);
  };
}

}  // namespace lychnite::cli
