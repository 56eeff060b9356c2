#include "lychnite/volume/volume.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "lychnite/base/error.h"
#include "reference/single_light.h"
#include "volume/gather.h"
#include "volume/interruptible.h"
#include "volume/light_field.h"
#include "volume/picture.h"
#include "volume/radiosity.h"
#include "volume/view.h"

namespace lychnite {

using namespace volume;

namespace {

// Share of lines through a mesh along which inside may be undefined: pinholes, slivers of self-intersection.
constexpr double kUndefined = 0.01;
constexpr int kMostPasses = 10000;
constexpr uint64_t kSinglePasses = 16;

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

bool sameRays(const RayLight& a, const RayLight& b) {
  return a.parallel == b.parallel && a.direction == b.direction && a.position == b.position;
}

/// An empty `from` is 0.
void addScaled(const std::vector<Lanes>& from, const Lanes& scale, std::vector<Lanes>& to) {
  for (size_t n = 0; n < from.size(); ++n) to[n] += scale * from[n];
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

struct VolumeSolver::Impl {
  VolumeSettings settings;
  std::map<const Mesh*, std::shared_ptr<const Shape>> shapes;
  std::map<const Mesh*, std::pair<std::weak_ptr<const Mesh>, double>> undefined;
  std::unique_ptr<RayScene> rays;
  World world;
  std::vector<Coefficients> media;  ///< per object and scene unit, that the fields were made for
  std::unique_ptr<Exchange> exchange;
  std::vector<Emission> emission;
  std::vector<LightField> fields;
  std::vector<std::unique_ptr<Gather>> gathers;
  std::vector<std::unique_ptr<LastFlight>> lastFlights;
  std::unique_ptr<View> view;  ///< of the last picture
  struct Single {              ///< of the last picture that shows it
    std::vector<RayLight> lights;
    std::vector<Coefficients> media;
    uint64_t seed = 0;
    bool full = false;
    std::vector<glm::vec3> radiance;
  } single;
  VolumeStats stats;

  double undefinedOf(const std::shared_ptr<const Mesh>& mesh);
  std::shared_ptr<const Shape> shapeOf(const std::shared_ptr<const Mesh>& mesh);
  bool makeBodies(const Scene& scene, const VolumeSettings& next);
  bool makeOrForgetBodies(const Scene& scene, const VolumeSettings& next, const Progress& progress);
  int passes() const;  ///< that the picture is made of
  LightSolver lightSolver() { return {world, emission, lastFlights, *exchange, settings, stats}; }
  void tell();
  template <class Add>
  void forLights(size_t object, Add add) const;
  NodeEstimate estimate(size_t object) const;
  FirstOrder firstOrder(size_t object, const std::vector<Lanes>& entering) const;
  NodeFlux flux(int object, Orders orders) const;
  glm::vec3 takeFine(size_t object, Orders orders, std::vector<Lanes>& flux) const;  ///< as the view sees it
  void refine(bool last, const Progress& progress);
  View& viewOf(int width, int height);
  const std::vector<glm::vec3>& singleOf(uint64_t seed, Detail detail, const Progress& progress);
  void converge(VolumeSolver& solver, const RenderSettings& wish, const Progress& progress);
};

double VolumeSolver::Impl::undefinedOf(const std::shared_ptr<const Mesh>& mesh) {
  auto& known = undefined[mesh.get()];
  if (known.first.lock() != mesh) known = {mesh, undefinedInside(LocalMesh(*mesh))};
  return known.second;
}

std::shared_ptr<const Shape> VolumeSolver::Impl::shapeOf(const std::shared_ptr<const Mesh>& mesh) {
  auto& shape = shapes[mesh.get()];
  if (!shape || shape->mesh != mesh) shape = std::make_shared<const Shape>(mesh, settings.cells);
  return shape;
}

/// Brings shapes, rays and media up to date; true when lights have to be traced again.
bool VolumeSolver::Impl::makeBodies(const Scene& scene, const VolumeSettings& next) {
  const bool regrid = !rays || next.cells != settings.cells;
  const bool kept = !regrid && rays->adopt(scene);
  bool stale = next.collisions != settings.collisions || next.seed != settings.seed;
  const bool points = regrid || next.photons != settings.photons;
  settings = next;
  if (regrid) shapes.clear();
  if (!kept) {
    view.reset();
    rays = std::make_unique<RayScene>(scene);
    world.rays = rays.get();
    gathers.clear();
    gathers.resize(rays->objectCount());
  }
  std::vector<Coefficients> now;
  for (size_t i = 0; i < rays->objectCount(); ++i) now.push_back(rays->medium(int(i)));
  stale = stale || !kept || points || now != media;
  if (kept && now == media && !points) return stale;
  media = now;
  std::map<const Mesh*, std::shared_ptr<const Shape>> used;
  world.bodies.clear();
  if (points || !kept) emission.clear();
  for (size_t i = 0; i < rays->objectCount(); ++i) {
    world.bodies.emplace_back();
    if (!rays->opaque(int(i))) {
      const auto shape = shapeOf(scene.objects[i].mesh);
      used[shape->mesh.get()] = shape;
      world.bodies.back() = std::make_unique<Body>(shape, *rays, int(i), rays->objectCount() == 1);
    }
    if (points || !kept)
      emission.push_back(world.bodies.back() ? Emission(world.bodies.back()->shape->surface, settings.photons)
                                             : Emission());
  }
  shapes = std::move(used);
  lastFlights.resize(world.bodies.size());
  for (size_t i = 0; i < world.bodies.size(); ++i)
    if (world.bodies[i] && (points || !kept || lastFlights[i]->eta() != world.bodies[i]->medium.eta))
      lastFlights[i] = std::make_unique<LastFlight>(world, i);
  if (!kept) exchange = std::make_unique<Exchange>(world);
  world.returns = !exchange->empty();
  return true;
}

/// Of the light that has the fewest.
int VolumeSolver::Impl::passes() const {
  int least = fields.empty() ? 0 : fields[0].solved;
  for (const LightField& field : fields) least = std::min(least, field.solved);
  return least;
}

/// Calls add(field, power) for every light, power over the square of the object's size.
template <class Add>
void VolumeSolver::Impl::forLights(size_t object, Add add) const {
  const float size = world.bodies[object]->size;
  for (size_t l = 0; l < fields.size(); ++l) {
    const Rgb power = rays->lights()[l].power / double(size * size);
    add(fields[l], Lanes{float(power.x), float(power.y), float(power.z), 0});
  }
}

/// Of all lights together, all orders.
NodeEstimate VolumeSolver::Impl::estimate(size_t object) const {
  const Body& body = *world.bodies[object];
  const std::vector<Lanes> none(body.shape->surface.nodes().size(), Lanes{0, 0, 0, 0});
  NodeEstimate result{none, none, none, {}, 1};
  if (passes() > 0) result.half[0] = result.half[1] = none;
  forLights(object, [&](const LightField& field, const Lanes& p) {
    addScaled(field.beam[object], p, result.beam);
    addScaled(field.beamAgain[object], p, result.again);
    for (int half : {0, 1}) {
      if (passes() < 1) continue;
      addScaled(field.all[half][object], p, result.half[half]);
      addScaled(field.again[object], p, result.half[half]);
    }
    for (size_t n = 0; n < none.size(); ++n) result.entering[n] += p * field.entering[object].flux[n];
  });
  const double h = body.shape->grid.side();
  result.photons = settings.photons * passes() * h * h / body.shape->surface.area();
  return result;
}

FirstOrder VolumeSolver::Impl::firstOrder(size_t object, const std::vector<Lanes>& entering) const {
  const Body& body = *world.bodies[object];
  FirstOrder first{std::vector<Lanes>(entering.size(), Lanes{0, 0, 0, 0}), {}};
  forLights(object, [&](const LightField& field, const Lanes& p) {
    if (passes() < 1) addScaled(field.beamFirst[object], p, first.flux);
    for (int half : {0, 1})
      if (passes() > 0) addScaled(field.first[half][object], 0.5f * p, first.flux);
  });
  Lanes sum{0, 0, 0, 0}, all{0, 0, 0, 0};
  for (size_t n = 0; n < entering.size(); ++n) sum += first.flux[n], all += entering[n];
  const Lanes share = sum / (all + Lanes{1e-30f, 1e-30f, 1e-30f, 1});
  const double h = body.shape->grid.side();
  first.response = [share, h, &body](double q, int c) {
    return double(share[c]) * std::exp(-q / (h * body.system.medium().channel[c].sigma_tp));
  };
  return first;
}

NodeFlux VolumeSolver::Impl::flux(int object, Orders orders) const {
  const Body& body = *world.bodies[size_t(object)];
  const Smoother& smoother = body.shape->smoother;
  const double h = body.shape->grid.side();
  const NodeEstimate known = estimate(size_t(object));
  const Smoother::Response response = [&](double q, int c) {
    return body.system.medium().channel[c].response(q / h);
  };
  if (orders == Orders::kAll) return cleaned(smoother, body.shape->surface, known, response, nullptr);
  const FirstOrder first = firstOrder(size_t(object), known.entering);
  if (orders == Orders::kFirst) return {cleanedFirst(smoother, known, first), {}};
  return cleaned(smoother, body.shape->surface, known, response, &first);
}

/// Takes from a body's flux what pixels add themselves where nodes are too coarse: a share of what enters.
glm::vec3 VolumeSolver::Impl::takeFine(size_t object, Orders orders, std::vector<Lanes>& flux) const {
  const Body& body = *world.bodies[object];
  const double h = body.shape->grid.side();
  const CameraFrame camera = rays->camera(view->receivers().width, view->receivers().height);
  const double pixel =
      2 * camera.tanHalfFovY / camera.height * double(view->nearest(object)) / double(body.size);
  const double finest = std::numbers::pi * h / pixel;
  const Smoother::Response all = [&](double q, int c) {
    return body.system.medium().channel[c].response(q / h);
  };
  glm::vec3 share = fineShare(all, finest);
  if (share == glm::vec3(0)) return share;
  const std::vector<Lanes> entering = estimate(object).entering;
  if (orders == Orders::kMultiple) {
    const FirstOrder first = firstOrder(object, entering);
    share = fineShare([&](double q, int c) { return all(q, c) - first.response(q, c); }, finest);
  }
  addScaled(entering, Lanes{-share.x, -share.y, -share.z, 0}, flux);
  return share;
}

/// Sums up the statistics of all lights.
void VolumeSolver::Impl::tell() {
  stats.cells = stats.nodes = stats.samples = stats.memoryBytes = 0;
  for (const auto& body : world.bodies) {
    if (!body) continue;
    stats.cells += body->shape->grid.size();
    stats.nodes += body->shape->surface.nodes().size();
    stats.samples += body->shape->surface.samples().size();
    stats.memoryBytes += body->shape->memoryBytes() + body->system.memoryBytes();
    stats.memoryBytes += fields.size() * sizeof(Lanes) *
                         (11 * body->shape->surface.nodes().size() + 6 * body->shape->grid.size());
  }
  stats.memoryBytes += exchange->memoryBytes() + (view ? view->memoryBytes() : 0);
  Rgb entered(0), left(0), absorbed(0), unscattered(0), lost(0);
  stats.passes = passes();
  for (size_t l = 0; l < fields.size(); ++l) {
    const LightField& field = fields[l];
    const Rgb power = rays->lights()[l].power;
    const Tally told = field.told();
    const Rgb each = power / field.passesTold();
    entered += told.entered * each;
    left += told.left * each;
    unscattered += told.unscattered * each;
    lost += told.lost * each;
    absorbed += field.absorbed * power;
    const auto tellExits = [&](const LightField::Fluxes& phi, double share) {
      for (size_t i = 0; i < phi.size(); ++i) {
        if (!world.bodies[i]) continue;
        std::vector<Lanes> exits;
        world.bodies[i]->system.exits(phi[i], exits);
        for (const Lanes& e : exits) left += share * Rgb(e[0], e[1], e[2]) * power;
      }
    };
    if (field.solved == 0) tellExits(field.phiBeam, 1);
    if (field.solved > 0)
      for (const auto& phi : field.phi) tellExits(phi, 0.5);
  }
  entered = glm::max(entered, Rgb(1e-300));
  stats.left = left / entered;
  stats.absorbed = absorbed / entered;
  stats.unscattered = unscattered / entered;
  stats.lost = lost / entered;
}

/// makeBodies(), after whose interruption nothing half made is gone on from.
bool VolumeSolver::Impl::makeOrForgetBodies(const Scene& scene, const VolumeSettings& next,
                                            const Progress& progress) {
  const Interruptible inside(progress, {"volume: geometry", 0, ""});
  try {
    return makeBodies(scene, next);
  } catch (...) {
    view.reset();
    rays.reset();
    throw;
  }
}

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
  const auto start = std::chrono::steady_clock::now();
  const bool stale = all.makeOrForgetBodies(scene, settings, progress);
  all.stats.geometryMs = since(start);
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

std::vector<glm::vec3> VolumeSolver::vertexRadiosity(int object, Orders orders) const {
  auto& gather = impl_->gathers[size_t(object)];
  if (!gather) gather = std::make_unique<Gather>(*impl_->world.bodies[size_t(object)]->shape);
  return gather->vertices(impl_->flux(object, orders).flux);
}

double VolumeSolver::noise() const {
  if (impl_->stats.passes < 1) return 0;
  double squares = 0, sum = 0, area = 0;
  for (size_t i = 0; i < impl_->world.bodies.size(); ++i) {
    if (!impl_->world.bodies[i]) continue;
    const auto& nodes = impl_->world.bodies[i]->shape->surface.nodes();
    const NodeFlux light = impl_->flux(int(i), Orders::kAll);
    if (light.variance.empty()) return 0;
    for (size_t n = 0; n < nodes.size(); ++n) {
      if (!(nodes[n].area > 0)) continue;
      for (int c = 0; c < 3; ++c) {
        squares += double(light.variance[n][c] / nodes[n].area);
        sum += double(light.flux[n][c]);
      }
      area += 3 * double(nodes[n].area);
    }
  }
  return sum > 0 ? std::sqrt(squares * area) / sum : 0;
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
    impl_->converge(*this, settings, progress);
    Image image = picture(settings, progress);
    impl_->tell();  // with the memory of what the camera sees
    tellStats(impl_->stats, image);
    if (impl_->stats.passes > 0) image.metadata["noise"] = fmt::format("{:.6g}", noise());
    image.metadata["seconds"] = fmt::format("{:.3f}", since(start) / 1000);
    return image;
  });
}

const VolumeStats& VolumeSolver::stats() const {
  return impl_->stats;
}

}  // namespace lychnite
