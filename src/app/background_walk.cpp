#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include "app/refiner.h"
#include "lychnite/app/background.h"
#include "lychnite/reference/reference.h"
#include "lychnite/scene/scene_file.h"

namespace lychnite {

void lowerThreadPriority(int niceness) {
  if (niceness <= 0) return;
#ifdef __linux__
  // On Linux a niceness belongs to a thread, and the threads that it starts inherit it.
  setpriority(PRIO_PROCESS, id_t(syscall(SYS_gettid)), niceness);
#endif
}

int backgroundThreads(int wanted) {
  return wanted > 0 ? wanted : std::max(1, int(std::thread::hardware_concurrency()) / 2);
}

RefinerJob makeJob(const Scene& scene, const RenderSettings& s) {
  std::string key = sceneToToml(scene) + fmt::format("{}x{} {} {} {} {} {} {}", s.width, s.height, s.seed,
                                                     componentsName(s.components), methodName(s.method),
                                                     profileName(s.profile), s.cells, s.collisions);
  for (const Object& object : scene.objects) key += fmt::format(" {}", fmt::ptr(object.mesh.get()));
  return {.scene = scene, .settings = s, .key = std::move(key)};
}

namespace {

constexpr double kFirstSamples = 0.125;  // photons a pixel of the first picture; every round doubles them,
constexpr double kMostNewSamples = 4;    // up to so many more

double number(const Image& image, const char* name) {
  const auto found = image.metadata.find(name);
  return found == image.metadata.end() ? 0 : std::strtod(found->second.c_str(), nullptr);
}

using WalkRefiner = Refiner<BackgroundWalk::Result>;

/// Rounds of growing length, each of which goes on from the one before. By photons and not by time, because
/// a busy machine may leave a thread of low priority none.
void refineWalk(const RefinerJob& job, const WalkRefiner::Ticket& ticket, double enough) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  RenderSettings settings = job.settings;
  std::shared_ptr<const Image> last;
  const Progress progress([&](const Progress::Update&) { return ticket.valid(); });
  for (double samples = kFirstSamples;; samples += std::min(samples, kMostNewSamples)) {
    settings.samples = samples;
    const ReferenceOptions options{.resume = last.get(), .keepState = true};
    last = std::make_shared<const Image>(renderReference(job.scene, settings, progress, {}, options));
    const std::chrono::duration<double> spent = Clock::now() - start;
    const BackgroundWalk::Result now{last, number(*last, "noise"), spent.count(),
                                     number(*last, "photons_per_pixel")};
    if (!ticket.publish(now) || now.noise <= enough) return;
  }
}

}  // namespace

struct BackgroundWalk::Impl {
  explicit Impl(const Options& options)
      : threads(backgroundThreads(options.threads)),
        refiner(
            [enough = options.enough](const RefinerJob& job, const WalkRefiner::Ticket& ticket) {
              refineWalk(job, ticket, enough);
            },
            options.yields ? 19 : 0) {}
  int threads;
  WalkRefiner refiner;
};

BackgroundWalk::BackgroundWalk(const Options& options) : impl_(std::make_unique<Impl>(options)) {}
BackgroundWalk::~BackgroundWalk() = default;

void BackgroundWalk::want(const Scene& scene, const RenderSettings& settings) {
  RenderSettings own = settings;
  own.method = Method::kWalk;
  own.aovs = {"stderr"};
  own.threads = impl_->threads;
  own.noise = 0;
  impl_->refiner.want(makeJob(scene, own));
}

void BackgroundWalk::stop() {
  impl_->refiner.stop();
}

std::optional<BackgroundWalk::Result> BackgroundWalk::newest() const {
  return impl_->refiner.newest();
}

std::string BackgroundWalk::problem() const {
  return impl_->refiner.problem();
}

}  // namespace lychnite
