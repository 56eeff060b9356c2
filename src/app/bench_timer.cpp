#include "app/bench_timer.h"

#include <chrono>
#include <ctime>

namespace lychnite::bench {

double wallMs() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

double cpuMs() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
}

void FrameTimer::frame(const Scene& scene) {
  const double wall = wallMs(), cpu = cpuMs();
  drawing_.draw(scene);
  wall_.push_back(wallMs() - wall);
  cpu_.push_back(cpuMs() - cpu);
  for (const auto& [name, ms] : drawing_.passes()) {
    if (!passes_.contains(name)) order_.push_back(name);
    passes_[name].push_back(ms);
  }
}

std::vector<BenchPass> FrameTimer::passes() const {
  std::vector<BenchPass> result;
  for (const std::string& name : order_) result.push_back({name, statisticOf(passes_.at(name))});
  return result;
}

}  // namespace lychnite::bench
