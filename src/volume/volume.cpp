#include "lychnite/volume/volume.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "lychnite/base/error.h"
#include "volume/emission.h"
#include "volume/exchange.h"
#include "volume/gather.h"
#include "volume/picture.h"

namespace lychnite {

using namespace volume;

namespace {

// Share of lines through a mesh along which inside may be undefined: pinholes, slivers of self-intersection.
constexpr double kUndefined = 0.01;
// Standard deviation of the smoothing on the surface, in voxels: after the first pass of photons and at
// least.
constexpr double kWidth = 1.6, kLeastWidth = 0.7;
constexpr double kBandWave = 1.9;       // times 1/width: where the band between two widths has its peak
constexpr int kExchangeCollisions = 2;  // of light that meets another surface, before the solver takes over

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// What one light of power 1 makes of the scene.
struct LightField {
  RayLight light;  ///< traced for
  int passes = 0;
  std::vector<Deposits> deposits;  ///< sums over the passes
  Tally tally;
  std::vector<std::vector<Lanes>> phi, phiBack;     ///< solutions, kept as first guesses
  std::vector<std::vector<float>> entering;         ///< flux that enters each node, per body
  std::vector<std::vector<Lanes>> first, multiple;  ///< flux that leaves at each node, per body
  Rgb absorbed{0};
};

void tellStats(const VolumeStats& stats, Image& image) {
  const auto put = [&](const char* key, const std::string& value) {
    image.metadata[std::string("volume.") + key] = value;
  };
  const auto rgb = [](const Rgb& c) { return fmt::format("{:.6g} {:.6g} {:.6g}", c.x, c.y, c.z); };
  put("geometry_ms", fmt::format("{:.1f}", stats.geometryMs));
  put("source_ms", fmt::format("{:.1f}", stats.sourceMs));
  put("solve_ms", fmt::format("{:.1f}", stats.solveMs));
  put("exchange_ms", fmt::format("{:.1f}", stats.exchangeMs));
  put("cells", fmt::format("{}", stats.cells));
  put("memory_bytes", fmt::format("{}", stats.memoryBytes));
  put("passes", fmt::format("{}", stats.passes));
  put("iterations", fmt::format("{}", stats.iterations));
  put("left", rgb(stats.left));
  put("absorbed", rgb(stats.absorbed));
  put("unscattered", rgb(stats.unscattered));
  put("lost", rgb(stats.lost));
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
  VolumeStats stats;

  double undefinedOf(const std::shared_ptr<const Mesh>& mesh);
  std::shared_ptr<const Shape> shapeOf(const std::shared_ptr<const Mesh>& mesh);
  bool makeBodies(const Scene& scene, const VolumeSettings& next);
  void trace(LightField& field);
  void solve(LightField& field);
  void exchangeLight(LightField& field);
  void tell();
  std::vector<Lanes> flux(int object, Orders orders) const;
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
  if (!kept) exchange = std::make_unique<Exchange>(world);
  return true;
}

void VolumeSolver::Impl::trace(LightField& field) {
  const auto start = std::chrono::steady_clock::now();
  Traced traced = traceLight(world, emission, field.light, settings.collisions, settings.seed, field.passes);
  if (field.passes == 0) {
    field.entering = enteringFlux(world, field.light);
    field.deposits = std::move(traced.deposits);
    field.tally = traced.tally;
  } else {
    for (size_t i = 0; i < field.deposits.size(); ++i)
      if (world.bodies[i]) field.deposits[i] += traced.deposits[i];
    field.tally += traced.tally;
  }
  ++field.passes;
  stats.flights += traced.tally.flights;
  stats.rays += traced.tally.rays;
  stats.sourceMs += since(start);
}

void VolumeSolver::Impl::solve(LightField& field) {
  const auto start = std::chrono::steady_clock::now();
  const size_t bodies = world.bodies.size();
  field.phi.resize(bodies);
  field.phiBack.resize(bodies);
  field.first.assign(bodies, {});
  field.multiple.assign(bodies, {});
  field.absorbed = field.tally.absorbed / double(field.passes);
  const float each = 1 / float(field.passes);
  for (size_t i = 0; i < bodies; ++i) {
    if (!world.bodies[i]) continue;
    const DiffusionSystem& system = world.bodies[i]->system;
    std::vector<Lanes> Q = field.deposits[i].source;
    for (Lanes& q : Q) q *= each;
    stats.iterations += system.solve(Q, field.phi[i], settings.tolerance).iterations;
    system.exits(field.phi[i], field.multiple[i]);
    field.first[i] = field.deposits[i].first;
    for (size_t n = 0; n < field.first[i].size(); ++n) {
      field.first[i][n] *= each;
      field.multiple[i][n] += field.deposits[i].later[n] * each;
    }
    field.absorbed += system.absorbed(field.phi[i]);
  }
  stats.solveMs += since(start);
  exchangeLight(field);
}

/// Light that leaves and meets a surface again, once by tracing and a solve; what would go on the same way is
/// taken as a geometric series.
void VolumeSolver::Impl::exchangeLight(LightField& field) {
  if (exchange->empty()) return;
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::vector<Lanes>> leaving = field.multiple;
  for (size_t i = 0; i < leaving.size(); ++i)
    for (size_t n = 0; n < leaving[i].size(); ++n) leaving[i][n] += field.first[i][n];
  Tally tally;
  const int collisions = std::min(settings.collisions, kExchangeCollisions);
  const std::vector<Deposits> back = exchange->send(world, leaving, collisions, settings.seed, tally);
  for (size_t i = 0; i < back.size(); ++i) {
    if (!world.bodies[i]) continue;
    const DiffusionSystem& system = world.bodies[i]->system;
    std::vector<Lanes> exits;
    stats.iterations +=
        system.solve(back[i].source, field.phiBack[i], std::max(0.03, settings.tolerance)).iterations;
    system.exits(field.phiBack[i], exits);
    Lanes before{0, 0, 0, 0}, after{0, 0, 0, 0};
    for (const Lanes& l : leaving[i]) before += l;
    for (size_t n = 0; n < exits.size(); ++n) after += exits[n] += back[i].later[n];
    Lanes series{1, 1, 1, 1};
    for (int c = 0; c < 3; ++c)
      if (before[c] > 0) series[c] = 1 / (1 - std::min(0.9f, after[c] / before[c]));
    for (size_t n = 0; n < exits.size(); ++n) field.multiple[i][n] += exits[n] * series;
  }
  stats.exchangeMs += since(start);
}

std::vector<Lanes> VolumeSolver::Impl::flux(int object, Orders orders) const {
  const Body& body = *world.bodies[size_t(object)];
  const std::vector<Lanes> none(body.shape->surface.nodes().size(), Lanes{0, 0, 0, 0});
  std::vector<Lanes> first = none, multiple = none, entering = none;
  Lanes sums[2] = {{0, 0, 0, 0}, {0, 0, 0, 0}};
  for (size_t l = 0; l < fields.size(); ++l) {
    const Rgb power = rays->lights()[l].power / double(body.size * body.size);
    const Lanes p{float(power.x), float(power.y), float(power.z), 0};
    const LightField& field = fields[l];
    for (size_t n = 0; n < none.size(); ++n) {
      first[n] += p * field.first[size_t(object)][n];
      multiple[n] += p * field.multiple[size_t(object)][n];
      entering[n] += p * field.entering[size_t(object)][n];
      sums[0] += p * field.first[size_t(object)][n];
      sums[1] += p * field.entering[size_t(object)][n];
    }
  }
  const double h = body.shape->grid.side();
  const Smoother& smoother = body.shape->smoother;
  std::vector<Lanes> sum = none;
  if (orders != Orders::kMultiple) sum = first;
  if (orders != Orders::kFirst)
    for (size_t n = 0; n < sum.size(); ++n) sum[n] += multiple[n];
  const double w =
      std::clamp(kWidth * std::pow(double(std::max(1, stats.passes)), -0.25), kLeastWidth, kWidth);
  sum = smoother.smoothed(sum, w);
  double before = 0;
  for (double next : {0.25 * w, 0.5 * w, w}) {
    std::vector<Lanes> wider = smoother.smoothed(entering, std::sqrt(next * next - before * before));
    const double q = kBandWave / (next * h);
    Lanes response{0, 0, 0, 0};
    for (int c = 0; c < 3; ++c) {
      const Diffusion& d = body.system.medium().channel[c];
      const double r1 = sums[1][c] > 0 ? double(sums[0][c] / sums[1][c]) * std::exp(-q / d.sigma_tp) : 0;
      const double all = std::max(r1, d.response(q));
      response[c] = float(orders == Orders::kAll ? all : orders == Orders::kFirst ? r1 : all - r1);
    }
    for (size_t n = 0; n < sum.size(); ++n) sum[n] += response * (entering[n] - wider[n]);
    entering = std::move(wider);
    before = next;
  }
  return sum;
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
                         (4 * body->shape->surface.nodes().size() + 3 * body->shape->grid.size());
  }
  stats.memoryBytes += exchange->memoryBytes();
  Rgb entered(0), left(0), absorbed(0), unscattered(0), lost(0);
  stats.passes = 0;
  for (size_t l = 0; l < fields.size(); ++l) {
    const LightField& field = fields[l];
    const Rgb power = rays->lights()[l].power;
    const Rgb each = power / double(field.passes);
    stats.passes = std::max(stats.passes, field.passes);
    entered += field.tally.entered * each;
    left += field.tally.left * each;
    unscattered += field.tally.unscattered * each;
    lost += field.tally.lost * each;
    absorbed += field.absorbed * power;
    for (size_t i = 0; i < field.phi.size(); ++i) {
      if (!world.bodies[i]) continue;
      std::vector<Lanes> exits;
      world.bodies[i]->system.exits(field.phi[i], exits);
      for (const Lanes& e : exits) left += Rgb(e[0], e[1], e[2]) * power;
    }
  }
  entered = glm::max(entered, Rgb(1e-300));
  stats.left = left / entered;
  stats.absorbed = absorbed / entered;
  stats.unscattered = unscattered / entered;
  stats.lost = lost / entered;
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
  progress.check({"volume: geometry", 0, ""});
  const bool stale = all.makeBodies(scene, settings);
  all.stats.geometryMs = since(start);
  const auto& lights = all.rays->lights();
  all.fields.resize(lights.size());
  for (size_t l = 0; l < lights.size(); ++l) {
    LightField& field = all.fields[l];
    progress.check({"volume: light", double(l) / double(lights.size()), ""});
    if (!stale && field.passes > 0 && sameRays(field.light, lights[l])) continue;
    field.light = lights[l];
    field.passes = 0;
    all.trace(field);
    all.solve(field);
  }
  all.tell();
}

void VolumeSolver::refine(const Progress& progress) {
  impl_->stats.sourceMs = impl_->stats.solveMs = impl_->stats.exchangeMs = 0;
  impl_->stats.iterations = 0;
  for (LightField& field : impl_->fields) {
    progress.check({"volume: light", 0, ""});
    impl_->trace(field);
    impl_->solve(field);
  }
  impl_->tell();
}

std::vector<glm::vec3> VolumeSolver::vertexRadiosity(int object, Orders orders) const {
  auto& gather = impl_->gathers[size_t(object)];
  if (!gather) gather = std::make_unique<Gather>(*impl_->world.bodies[size_t(object)]->shape);
  return gather->vertices(impl_->flux(object, orders));
}

Image VolumeSolver::picture(const RenderSettings& settings, const Progress& progress) const {
  std::vector<std::vector<Lanes>> all(impl_->world.bodies.size()), multiple(all.size());
  for (size_t i = 0; i < all.size(); ++i) {
    if (!impl_->world.bodies[i]) continue;
    all[i] = impl_->flux(int(i), Orders::kAll);
    multiple[i] = impl_->flux(int(i), Orders::kMultiple);
  }
  return volumePicture(*impl_->rays, impl_->world, {all, multiple}, settings, progress);
}

Image VolumeSolver::render(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  tbb::task_arena arena(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic);
  return arena.execute([&] {
    const auto start = std::chrono::steady_clock::now();
    update(scene, {.cells = settings.cells, .collisions = settings.collisions, .seed = settings.seed},
           progress);
    while (impl_->stats.passes > 0 && impl_->stats.passes < settings.passes) refine(progress);
    Image image = picture(settings, progress);
    tellStats(impl_->stats, image);
    image.metadata["seconds"] = fmt::format("{:.3f}", since(start) / 1000);
    return image;
  });
}

const VolumeStats& VolumeSolver::stats() const {
  return impl_->stats;
}

}  // namespace lychnite
