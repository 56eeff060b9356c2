#include "lychnite/volume/volume.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lychnite/base/error.h"
#include "volume/interruptible.h"
#include "volume/picture.h"
#include "volume/solver.h"

namespace lychnite {

using namespace volume;

namespace {

// Share of lines through a mesh along which inside may be undefined: pinholes, slivers of self-intersection.
constexpr double kUndefined = 0.01;
constexpr int kMostPasses = 10000;
constexpr uint64_t kSinglePasses = 16;
constexpr double kMostLooked = 128 * 128;  // pixels that photons are aimed by

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

bool sameRays(const RayLight& a, const RayLight& b) {
  return a.parallel == b.parallel && a.direction == b.direction && a.position == b.position;
}

void requireRange(double value, double low, double high, const char* where) {
  if (!(value >= low && value <= high))
    throw Error({.where = where,
                 .expected = fmt::format("a number from {} to {}", low, high),
                 .found = fmt::format("{}", value),
                 .todo = {}},
                Error::Kind::kUsage);
}

}  // namespace

/// Does `work` on a light; after an interruption nothing half done is left of it.
template <class Work>
void orForget(LightField& field, Work work) {
  try {
    work();
  } catch (...) {
    field = {};
    throw;
  }
}

VolumeSolver::VolumeSolver() : impl_(std::make_unique<Impl>()) {}
VolumeSolver::~VolumeSolver() = default;
VolumeSolver::VolumeSolver(VolumeSolver&&) noexcept = default;
VolumeSolver& VolumeSolver::operator=(VolumeSolver&&) noexcept = default;

std::string VolumeSolver::obstacle(const Scene& scene) {
  for (const Object& object : scene.objects) {
    if (object.material.opaque) continue;
    const double share = impl_->undefinedOf(object.mesh);
    if (share > kUndefined)
      return fmt::format(
          "the mesh of {} is open or inside out in places: inside is undefined along {:.1f} % of the lines "
          "through it",
          object.name.empty() ? object.model : object.name, 100 * share);
  }
  return "";
}

void VolumeSolver::update(const Scene& scene, const VolumeSettings& settings, const Progress& progress) {
  validate(scene);
  requireRange(settings.cells, 8, 192, "cells");
  requireRange(settings.collisions, 1, 64, "collisions");
  requireRange(settings.photons, 1024, 1 << 24, "photons");
  requireRange(settings.tolerance, 1e-6, 0.5, "tolerance");
  Impl& all = *impl_;
  all.stats = {};
  all.aim = {};
  const auto start = std::chrono::steady_clock::now();
  const bool stale = all.makeOrForgetBodies(scene, settings, progress);
  all.stats.geometryMs = since(start);
  all.refuseLightsInside();
  const auto& lights = all.rays->lights();
  all.fields.resize(lights.size());
  if (stale)
    for (LightField& field : all.fields) field.entering.clear();
  for (size_t l = 0; l < lights.size(); ++l) {
    LightField& field = all.fields[l];
    const Interruptible inside(progress, {"volume: light", double(l) / double(lights.size()), ""});
    const bool made = !field.entering.empty();
    if (made && sameRays(field.light, lights[l])) continue;
    field.light = lights[l];
    field.light.power = Rgb(1);
    orForget(field, [&] { all.lightSolver().beam(field); });
  }
  all.tell();
}

/// Passes that are not the last of several need not be solved for.
void VolumeSolver::Impl::refine(bool last, const Progress& progress) {
  stats.sourceMs = stats.solveMs = stats.exchangeMs = 0;
  stats.iterations = 0;
  for (LightField& field : fields) {
    const Interruptible inside(progress, {"volume: light", 0, ""});
    lightSolver().trace(field);
    if (last) orForget(field, [&] { lightSolver().solve(field); });
  }
  if (last) tell();
}

void VolumeSolver::refine(const Progress& progress) {
  impl_->refine(true, progress);
}

/// Of the scene's camera.
View& VolumeSolver::Impl::viewOf(int width, int height) {
  if (view && view->isOf(*rays, world, width, height)) return *view;
  view.reset();  // first, so that there is never memory for two
  single = {};
  view = std::make_unique<View>(*rays, world, width, height);
  return *view;
}

/// As the view sees it.
const std::vector<glm::vec3>& VolumeSolver::Impl::singleOf(uint64_t seed, Detail detail,
                                                           const Progress& progress) {
  const bool full = detail == Detail::kFull;
  const auto same = [](const RayLight& a, const RayLight& b) { return sameRays(a, b) && a.power == b.power; };
  if (!single.radiance.empty() && std::ranges::equal(single.lights, rays->lights(), same) &&
      single.media == media && single.seed == seed && single.full >= full)
    return single.radiance;
  single = {};
  const SingleLight& light = view->singleLight();
  std::vector<glm::vec3> radiance = full ? light.mean(kSinglePasses, seed, progress) : light.shared(progress);
  single = {rays->lights(), media, seed, full, std::move(radiance)};
  return single.radiance;
}

Image VolumeSolver::picture(const RenderSettings& settings, const Progress& progress, Detail detail) const {
  const Interruptible inside(progress, {"volume: picture", 0, ""});
  View& seen = impl_->viewOf(settings.width, settings.height);
  NodeLight light;
  for (size_t i = 0; i < impl_->world.bodies.size(); ++i) {
    for (auto* part : {&light.all, &light.multiple, &light.error}) part->emplace_back();
    for (auto* part : {&light.fineAll, &light.fineMultiple}) part->emplace_back(0);
    if (!impl_->world.bodies[i]) continue;
    const bool error = settings.wants("stderr");
    if (settings.wants("radiosity")) {
      light.all.back() = impl_->flux(int(i), Orders::kAll).flux;
      light.fineAll.back() = impl_->takeFine(i, Orders::kAll, light.all.back());
    }
    if (!settings.components.multiple && !error) continue;
    NodeFlux multiple = impl_->flux(int(i), Orders::kMultiple);
    light.multiple.back() = std::move(multiple.flux);
    light.fineMultiple.back() = impl_->takeFine(i, Orders::kMultiple, light.multiple.back());
    light.error.back() = std::move(multiple.variance);
    for (Lanes& e : light.error.back())
      for (int c = 0; c < 3; ++c) e[c] = std::sqrt(e[c]);
  }
  const std::vector<glm::vec3> none;
  const auto& single = settings.components.single ? impl_->singleOf(settings.seed, detail, progress) : none;
  return volumePicture(*impl_->rays, impl_->world, light, seen, single, settings, detail == Detail::kPreview,
                       progress);
}

void VolumeSolver::aim(const RenderSettings& settings) {
  impl_->aimAt(settings);
}

bool VolumeSolver::keepsView(const RenderSettings& settings) const {
  return impl_->view && impl_->view->complete() &&
         impl_->view->isOf(*impl_->rays, impl_->world, settings.width, settings.height);
}

/// Passes of photons as asked for: a number, or until the noise or the time is up.
void VolumeSolver::Impl::converge(VolumeSolver& solver, const RenderSettings& wish,
                                  const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const bool openEnded = wish.noise > 0 || wish.timeLimit > 0;
  const int most = openEnded ? kMostPasses : wish.passes;
  int look = 1;  // the noise is a part of a pass's work to tell
  for (int pass = 1; !fields.empty() && pass <= most; ++pass) {
    const bool timeIsUp = wish.timeLimit > 0 && since(start) >= 1000 * wish.timeLimit;
    const bool last = pass == most || timeIsUp || (wish.noise > 0 && pass == look);
    refine(last, progress);
    if (timeIsUp) return;
    if (wish.noise > 0 && last) {
      const double ratio = solver.noise() / wish.noise;
      if (ratio <= 1) return;
      look = pass + int(std::clamp(pass * (ratio * ratio - 1), 1.0, double(pass)));
    }
  }
}

Image VolumeSolver::render(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  tbb::task_arena arena(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic);
  return arena.execute([&] {
    const auto start = std::chrono::steady_clock::now();
    const int cells = settings.cells > 0 ? settings.cells : volumeCells(scene);
    update(scene, {.cells = cells, .collisions = settings.collisions, .seed = settings.seed}, progress);
    aim(settings);
    impl_->converge(*this, settings, progress);
    Image image = picture(settings, progress);
    impl_->tell();  // with the memory of what the camera sees
    tellStats(impl_->stats, image);
    if (impl_->stats.passes > 0) image.metadata["noise"] = fmt::format("{:.6g}", noise());
    image.metadata["seconds"] = fmt::format("{:.3f}", since(start) / 1000);
    return image;
  });
}

void VolumeSolver::Impl::aimAt(const RenderSettings& wish) {
  const double pixels = double(wish.width) * wish.height;
  if (pixels <= kMostLooked) {
    View& seen = viewOf(wish.width, wish.height);
    seen.forPixels([](const View::Pixel&) {});
    aim = volume::aimAt(seen, world);
  } else {
    const double scale = std::sqrt(kMostLooked / pixels);
    View seen(*rays, world, std::max(1, int(wish.width * scale)), std::max(1, int(wish.height * scale)));
    seen.forPixels([](const View::Pixel&) {});
    aim = volume::aimAt(seen, world);
  }
  for (LightField& field : fields) field.emission.clear();
}

const VolumeStats& VolumeSolver::stats() const {
  return impl_->stats;
}

}  // namespace lychnite
