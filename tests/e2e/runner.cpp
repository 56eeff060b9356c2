#include "e2e/runner.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace lychnite::e2e {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The environment of the tests with some variables changed, "NAME=value" each.
std::vector<std::string> changedEnvironment(const Environment& changes) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    if (!changes.contains(text.substr(0, text.find('=')))) result.push_back(text);
  }
  for (const auto& [name, value] : changes)
    if (!value.empty()) result.push_back(name + "=" + value);
  return result;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

/// True once process `pid` handles SIGINT itself or has ended.
bool catchesInterrupts(int pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("State:") && line.find('Z') != std::string::npos) return true;
    if (line.starts_with("SigCgt:"))
      return (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1) != 0;
  }
  return true;
}

/// Of a running process; 0 when it has none any more.
size_t residentBytes(int pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/statm");
  size_t all = 0, resident = 0;
  file >> all >> resident;
  return resident * size_t(sysconf(_SC_PAGESIZE));
}

bool hasEnded(int pid) {
  siginfo_t info{};
  return waitid(P_PID, id_t(pid), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == pid;
}

}  // namespace

Scratch::Scratch() {
  std::string pattern = (fs::temp_directory_path() / "lychnite-e2e-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot make a scratch folder");
  captured_ = pattern;
  folder_ = captured_ / "run";
  fs::create_directory(folder_);
}

Scratch::~Scratch() {
  std::error_code ignored;
  fs::remove_all(captured_, ignored);
}

std::set<std::string> Scratch::names() const {
  std::set<std::string> result;
  for (const auto& entry : fs::directory_iterator(folder_)) result.insert(entry.path().filename().string());
  return result;
}

void Scratch::write(const std::string& name, std::string_view text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::string Scratch::read(const std::string& name) const {
  return contents(folder_ / name);
}

int Scratch::start(const std::vector<std::string>& arguments, const Environment& environment) const {
  std::vector<std::string> words{LYCHNITE_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = changedEnvironment(environment);
  const std::string out = (captured_ / "stdout").string(), err = (captured_ / "stderr").string();
  constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), kFlags, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), kFlags, 0600);
  posix_spawn_file_actions_addchdir_np(&actions, folder_.c_str());
  pid_t pid = 0;
  const int failed = posix_spawn(&pid, LYCHNITE_PROGRAM, &actions, nullptr, pointers(words).data(),
                                 pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed) throw std::runtime_error("cannot start " LYCHNITE_PROGRAM);
  return pid;
}

Result Scratch::finish(int pid) const {
  int status = 0;
  rusage usage{};
  if (wait4(pid, &status, 0, &usage) != pid) throw std::runtime_error("cannot wait for the program");
  return {.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          .out = contents(captured_ / "stdout"),
          .err = contents(captured_ / "stderr"),
          .peakBytes = size_t(usage.ru_maxrss) * 1024};
}

Result Scratch::run(const std::vector<std::string>& arguments, const Environment& environment) const {
  return finish(start(arguments, environment));
}

Result Scratch::watch(const std::vector<std::string>& arguments, const Environment& environment,
                      const std::function<void(size_t)>& look) const {
  const int pid = start(arguments, environment);
  while (!hasEnded(pid)) {
    look(residentBytes(pid));
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
  return finish(pid);
}

Result Scratch::runAndInterrupt(const std::vector<std::string>& arguments, double seconds) const {
  const int pid = start(arguments, {});
  while (!catchesInterrupts(pid)) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  kill(pid, SIGINT);
  return finish(pid);
}

void expectOneLine(const Result& result, int status, const std::string& words) {
  EXPECT_EQ(result.status, status) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(result.err.rfind("lychnite: ", 0), 0u) << result.err;
  EXPECT_TRUE(result.err.ends_with("\n")) << result.err;
  EXPECT_NE(result.err.find(words), std::string::npos) << "'" << words << "' is not in: " << result.err;
}

std::vector<std::string> renderArguments(const std::string& model, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"render", model, "--resolution", "64x64", "--map", "128"};
  if (std::find(more.begin(), more.end(), "--method") == more.end())
    arguments.insert(arguments.end(), {"--method", "adaptive"});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

double relativeDifference(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height()) return std::numeric_limits<double>::infinity();
  double difference = 0, whole = 0;
  for (size_t i = 0; i < a.pixelCount(); ++i) {
    const glm::vec3 d = a.rgb(i) - b.rgb(i);
    difference += double(glm::dot(d, d));
    whole += double(glm::dot(b.rgb(i), b.rgb(i)));
  }
  return std::sqrt(difference / whole);
}

}  // namespace lychnite::e2e
