#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>

#include "gpu/object.h"

namespace lychnite::gpu {

/// Measures how long the device works on what is asked of it between begin() and end(). A ring of queries, so
/// that reading never waits unless asked to. One timer at a time may run in a context.
class GpuTimer {
 public:
  explicit GpuTimer(const std::string& label);

  void begin();
  void end();
  /// Milliseconds of the newest measurement that is done; never waits. Empty when none is.
  std::optional<double> poll();
  /// Milliseconds of the newest measurement, waiting for it. 0 when nothing was ever measured.
  double wait();

  /// begin() now, end() when it goes out of scope.
  class Scope {
   public:
    explicit Scope(GpuTimer& timer) : timer_(timer) { timer_.begin(); }
    ~Scope() { timer_.end(); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    GpuTimer& timer_;
  };

 private:
  class Query : public Object {
   public:
    explicit Query(const std::string& label);
    using Object::id;
    using Object::state;
    std::chrono::steady_clock::time_point begun;
    bool ended = false;  // holds a measurement that was not read yet
  };
  using Clock = std::chrono::steady_clock;
  static constexpr int kRing = 4;

  double read(const Query& query) const;

  /// Reads every measurement that is done, oldest first; waits for the newest when `wait`.
  void collect(bool wait);

  std::array<Query, kRing> ring_;
  int next_ = 0;
  std::optional<double> newestMs_;
};

}  // namespace lychnite::gpu
