#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <thread>

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include "lychnite/app/background.h"
#include "lychnite/reference/reference.h"
#include "lychnite/scene/scene_file.h"

namespace lychnite {

void lowerThreadPriority() {
#ifdef __linux__
  // On Linux a niceness belongs to a thread, and the threads that it starts inherit it.
  setpriority(PRIO_PROCESS, id_t(syscall(SYS_gettid)), 19);
#endif
}

namespace {

constexpr double kFirstSamples = 0.125;  // photons a pixel of the first picture; every round doubles them,
constexpr double kMostNewSamples = 4;    // up to so many more

int defaultThreads() {
  const int cores = int(std::thread::hardware_concurrency());
  return std::max(1, cores / 2);
}

std::string keyOf(const Scene& scene, const RenderSettings& s) {
  std::string key = sceneToToml(scene) +
                    fmt::format("{}x{} {} {}", s.width, s.height, s.seed, componentsName(s.components));
  for (const Object& object : scene.objects) key += fmt::format(" {}", fmt::ptr(object.mesh.get()));
  return key;
}

double number(const Image& image, const char* name) {
  const auto found = image.metadata.find(name);
  return found == image.metadata.end() ? 0 : std::strtod(found->second.c_str(), nullptr);
}

}  // namespace

struct BackgroundWalk::Impl {
  struct Job {
    Scene scene;
    RenderSettings settings;
    std::string key;
  };

  void work(const std::stop_token& stop);
  void refine(const Job& job, uint64_t version);

  int threads = 1;
  double enough = 0;
  bool yields = true;
  mutable std::mutex mutex;
  std::condition_variable_any wake;
  std::optional<Job> wanted;
  std::optional<Result> result;
  std::string problem;
  std::atomic<uint64_t> version{0};
  std::jthread thread;  // last: it uses the members above
};

void BackgroundWalk::Impl::work(const std::stop_token& stop) {
  if (yields) lowerThreadPriority();
  uint64_t done = 0;
  while (true) {
    Job job;
    {
      std::unique_lock lock(mutex);
      if (!wake.wait(lock, stop, [&] { return version != done; })) return;
      done = version;
      if (!wanted) continue;
      job = *wanted;
    }
    try {
      refine(job, done);
    } catch (const std::exception& error) {
      const std::lock_guard lock(mutex);
      if (version == done) problem = error.what();
    }
  }
}

/// Rounds of growing length, each of which goes on from the one before. By photons and not by time, because
/// a busy machine may leave a thread of low priority none.
void BackgroundWalk::Impl::refine(const Job& job, uint64_t mine) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  RenderSettings settings = job.settings;
  settings.method = Method::kWalk;
  settings.aovs = {"stderr"};
  settings.threads = threads;
  settings.noise = 0;
  std::shared_ptr<const Image> last;
  const Progress progress([&](const Progress::Update&) { return version == mine; });
  for (double samples = kFirstSamples;; samples += std::min(samples, kMostNewSamples)) {
    settings.samples = samples;
    const ReferenceOptions options{.resume = last.get(), .keepState = true};
    auto image = std::make_shared<const Image>(renderReference(job.scene, settings, progress, {}, options));
    if (version != mine) return;
    last = image;
    const std::chrono::duration<double> spent = Clock::now() - start;
    const Result now{image, number(*image, "noise"), spent.count(), number(*image, "photons_per_pixel")};
    const std::lock_guard lock(mutex);
    if (version != mine) return;
    result = now;
    if (now.noise <= enough) return;
  }
}

BackgroundWalk::BackgroundWalk(const Options& options) : impl_(std::make_unique<Impl>()) {
  impl_->threads = options.threads > 0 ? options.threads : defaultThreads();
  impl_->enough = options.enough;
  impl_->yields = options.yields;
  impl_->thread = std::jthread([impl = impl_.get()](const std::stop_token& token) { impl->work(token); });
}

BackgroundWalk::~BackgroundWalk() {
  stop();
  impl_->thread.request_stop();
}

void BackgroundWalk::want(const Scene& scene, const RenderSettings& settings) {
  std::string key = keyOf(scene, settings);
  {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->wanted && impl_->wanted->key == key) return;
    impl_->wanted = Impl::Job{scene, settings, std::move(key)};
    impl_->result.reset();
    impl_->problem.clear();
    ++impl_->version;
  }
  impl_->wake.notify_all();
}

void BackgroundWalk::stop() {
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->wanted) return;
  impl_->wanted.reset();
  impl_->result.reset();
  impl_->problem.clear();
  ++impl_->version;
  impl_->wake.notify_all();
}

std::optional<BackgroundWalk::Result> BackgroundWalk::newest() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->result;
}

std::string BackgroundWalk::problem() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->problem;
}

}  // namespace lychnite
