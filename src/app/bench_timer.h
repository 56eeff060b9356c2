#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "lychnite/app/bench.h"
#include "lychnite/scene/scene.h"

namespace lychnite::bench {

/// Milliseconds of the wall's clock, and of all threads of this process.
double wallMs();
double cpuMs();

/// What takes part in a row: something that draws a scene and waits until it is done, and tells its passes.
struct Drawing {
  std::function<void(const Scene& scene)> draw;
  std::function<std::vector<std::pair<std::string, double>>()>
      passes;  ///< name and milliseconds of the newest
};

/// Draws frames and keeps their times.
class FrameTimer {
 public:
  explicit FrameTimer(const Drawing& drawing) : drawing_(drawing) {}
  void frame(const Scene& scene);

  const std::vector<double>& wall() const { return wall_; }
  Statistic cpu() const { return statisticOf(cpu_); }
  std::vector<BenchPass> passes() const;

 private:
  const Drawing& drawing_;
  std::vector<double> wall_, cpu_;
  std::vector<std::string> order_;
  std::map<std::string, std::vector<double>> passes_;
};

}  // namespace lychnite::bench
