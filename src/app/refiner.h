#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "lychnite/app/background.h"
#include "lychnite/scene/scene.h"
#include "lychnite/scene/settings.h"

namespace lychnite {

/// What a picture made in the background depends on: two jobs are one when these are equal.
struct RefinerJob {
  Scene scene;
  RenderSettings settings;
  std::string key;
  bool keeps = false;     ///< the result that is there stays until this job has one
  bool finishes = false;  ///< goes on when another is wanted meanwhile; only stop() ends it
};
RefinerJob makeJob(const Scene& scene, const RenderSettings& settings);

/// One thread that works on the newest job it was given and publishes better and better results of it. All
/// of it may be called from any thread and never waits.
template <class Result>
class Refiner {
 public:
  /// Whether the job in hand is still the wanted one, and where its results go.
  class Ticket {
   public:
    bool valid() const { return finishes_ ? refiner_.stopped_ <= version_ : refiner_.version_ == version_; }
    /// False when nobody wants it any more.
    bool publish(Result result) const {
      const std::lock_guard lock(refiner_.mutex_);
      if (!valid()) return false;
      refiner_.result_ = std::move(result);
      refiner_.resultVersion_ = version_;
      refiner_.problem_.clear();
      return true;
    }

   private:
    friend class Refiner;
    Ticket(Refiner& refiner, uint64_t version, bool finishes)
        : refiner_(refiner), version_(version), finishes_(finishes) {}
    Refiner& refiner_;
    uint64_t version_;
    bool finishes_;
  };
  /// Runs on the thread for each job; returns when the job is done or its ticket no longer valid. What it
  /// throws becomes the problem().
  using Work = std::function<void(const RefinerJob&, const Ticket&)>;

  Refiner(Work work, int niceness)
      : work_(std::move(work)),
        thread_([this, niceness](const std::stop_token& token) { run(token, niceness); }) {}
  ~Refiner() {
    stop();
    thread_.request_stop();
  }
  Refiner(const Refiner&) = delete;
  Refiner& operator=(const Refiner&) = delete;

  void want(RefinerJob job) {
    {
      const std::lock_guard lock(mutex_);
      if (wanted_ && wanted_->key == job.key && wanted_->finishes == job.finishes) return;
      wanted_ = std::move(job);
      forget(wanted_->keeps);
    }
    wake_.notify_all();
  }
  void stop() {
    const std::lock_guard lock(mutex_);
    if (!wanted_) return;
    wanted_.reset();
    forget(false);
    stopped_ = version_.load();
    wake_.notify_all();
  }
  std::optional<Result> newest() const {
    const std::lock_guard lock(mutex_);
    return result_;
  }
  /// `behind`: it is an earlier job's, kept.
  std::optional<Result> newest(bool& behind) const {
    const std::lock_guard lock(mutex_);
    behind = resultVersion_ != version_;
    return result_;
  }
  std::string problem() const {
    const std::lock_guard lock(mutex_);
    return problem_;
  }

 private:
  void forget(bool keeps) {
    if (!keeps) {
      result_.reset();
      problem_.clear();
    }
    ++version_;
  }

  void run(const std::stop_token& stop, int niceness) {
    lowerThreadPriority(niceness);
    uint64_t done = 0;
    while (true) {
      RefinerJob job;
      {
        std::unique_lock lock(mutex_);
        if (!wake_.wait(lock, stop, [&] { return version_ != done; })) return;
        done = version_;
        if (!wanted_) continue;
        job = *wanted_;
      }
      const Ticket ticket(*this, done, job.finishes);
      try {
        work_(job, ticket);
      } catch (const std::exception& error) {
        const std::lock_guard lock(mutex_);
        if (ticket.valid()) problem_ = error.what();
      }
    }
  }

  Work work_;
  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<RefinerJob> wanted_;
  std::optional<Result> result_;
  std::string problem_;
  uint64_t resultVersion_ = 0;
  std::atomic<uint64_t> version_{0}, stopped_{0};
  std::jthread thread_;  // last: it uses the members above
};

}  // namespace lychnite
