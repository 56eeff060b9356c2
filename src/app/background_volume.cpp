#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>

#include "app/refiner.h"
#include "lychnite/app/background.h"
#include "lychnite/scene/scene_file.h"
#include "lychnite/volume/volume.h"

namespace lychnite {

using VolumeRefiner = Refiner<BackgroundVolume::Result>;

namespace {

constexpr int kNiceness = 4;  // two fifths of what a window's own thread gets, where it wants all

}  // namespace

struct BackgroundVolume::Impl {
  explicit Impl(const Options& options)
      : arena(backgroundThreads(options.threads)),
        most(options.passes),
        refiner([this](const RefinerJob& job,
                       const VolumeRefiner::Ticket& ticket) { arena.execute([&] { refine(job, ticket); }); },
                options.yields ? kNiceness : 0) {}

  void refine(const RefinerJob& job, const VolumeRefiner::Ticket& ticket);
  VolumeSolver& solverFor(const RefinerJob& job, VolumeSettings& settings);

  tbb::task_arena arena;
  int most;
  // Of the thread alone. What moves has a solver of its own, of fewer cells, so that neither has to make the
  // other's geometry anew.
  VolumeSolver still, live;
  std::string stillLight;  // what `still` has solved for, "" for nothing
  VolumeRefiner refiner;   // last: its thread uses the members above
};

namespace {

/// All that the light inside depends on, which the camera is not.
std::string lightKey(const Scene& scene, const VolumeSettings& settings) {
  Scene plain = scene;
  plain.camera = OrbitCamera{};
  std::string key = fmt::format("{} {} {}", sceneToToml(plain), settings.cells, settings.collisions);
  for (const Object& object : scene.objects) key += fmt::format(" {}", fmt::ptr(object.mesh.get()));
  return key;
}

}  // namespace

/// A camera that moves alone looks at what is solved already.
VolumeSolver& BackgroundVolume::Impl::solverFor(const RefinerJob& job, VolumeSettings& settings) {
  const std::string light = lightKey(job.scene, settings);
  if (!job.finishes || light == stillLight) {
    stillLight = light;
    return still;
  }
  settings.cells = std::min(settings.cells, kLiveVolumeCells);
  return live;
}

/// What is interrupted leaves a solver that other work goes on from: shapes and whole passes are kept.
void BackgroundVolume::Impl::refine(const RefinerJob& job, const VolumeRefiner::Ticket& ticket) {
  const RenderSettings& s = job.settings;
  if (std::string obstacle = still.obstacle(job.scene); !obstacle.empty()) {
    ticket.publish({.obstacle = std::move(obstacle), .scene = job.scene});
    return;
  }
  const Progress progress([&](const Progress::Update&) { return ticket.valid(); });
  VolumeSettings settings{
      .cells = s.cells > 0 ? s.cells : volumeCells(job.scene), .collisions = s.collisions, .seed = s.seed};
  VolumeSolver& solver = solverFor(job, settings);
  solver.update(job.scene, settings, progress);
  for (bool aimed = false; ticket.valid(); aimed = true) {
    const auto begun = std::chrono::steady_clock::now();
    const int passes = solver.stats().passes;
    const bool last = passes >= std::min(most, s.passes) || job.scene.lights.empty();
    const bool hurry = job.finishes || (passes == 0 && !last), newView = !solver.keepsView(s);
    auto image = std::make_shared<const Image>(
        solver.picture(s, progress, hurry ? VolumeSolver::Detail::kPreview : VolumeSolver::Detail::kFull));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    if (!ticket.publish({.image = std::move(image),
                         .passes = passes,
                         .scene = job.scene,
                         .pictureSeconds = took.count(),
                         .preview = hurry,
                         .newView = newView}))
      return;
    if (job.finishes || passes >= most || job.scene.lights.empty()) return;
    if (!aimed) solver.aim(s);
    solver.refine(progress);
  }
}

BackgroundVolume::BackgroundVolume(const Options& options) : impl_(std::make_unique<Impl>(options)) {}
BackgroundVolume::~BackgroundVolume() = default;

void BackgroundVolume::want(const Scene& scene, const RenderSettings& settings, bool moving) {
  RenderSettings own = settings;
  own.method = Method::kVolume;
  own.aovs.clear();
  RefinerJob job = makeJob(scene, own);
  job.keeps = true;
  job.finishes = moving;
  impl_->refiner.want(std::move(job));
}

void BackgroundVolume::stop() {
  impl_->refiner.stop();
}

std::optional<BackgroundVolume::Result> BackgroundVolume::newest() const {
  bool behind = false;
  auto result = impl_->refiner.newest(behind);
  if (result) result->behind = behind;
  return result;
}

std::string BackgroundVolume::problem() const {
  return impl_->refiner.problem();
}

}  // namespace lychnite
