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
#include "volume/interruptible.h"
#include "volume/picture.h"
#include "volume/radiosity.h"

namespace lychnite {

using namespace volume;

namespace {

// Share of lines through a mesh along which inside may be undefined: pinholes, slivers of self-intersection.
constexpr double kUndefined = 0.01;
constexpr int kMostPasses = 10000;
constexpr int kFewerReturn = 4;  // one of so many rays is sent from surface to surface before a whole pass
constexpr int kExchangeCollisions = 2;  // of light that meets another surface, before the solver takes over

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// What one light of power 1 makes of the scene.
struct LightField {
  RayLight light;  ///< traced for
  int passes = 0;
  double wholePasses = 0;  ///< of all points
  /// Two halves, of independent photons, of all bodies: sums over the passes.
  std::vector<Deposits> deposits[2];
  Tally tally;
  std::vector<std::vector<Lanes>> phi[2], phiBack;        ///< solutions, kept as first guesses
  std::vector<std::vector<Lanes>> again;                  ///< of `multiple`, light from other surfaces
  std::vector<std::vector<float>> entering;               ///< flux that enters each node, per body
  std::vector<std::vector<Lanes>> first[2], multiple[2];  ///< flux that leaves at each node, per body
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
  bool makeOrForgetBodies(const Scene& scene, const VolumeSettings& next, const Progress& progress);
  int nextOneOf(const LightField& field) const;
  double wholePasses() const;
  template <class Work>
  void orForget(LightField& field, Work work);
  void trace(LightField& field);
  void solveBody(LightField& field, size_t body, float each);
  void solve(LightField& field);
  void exchangeLight(LightField& field);
  std::vector<std::vector<Lanes>> lightThatReturns(LightField& field);
  void tell();
  NodeFlux flux(int object, Orders orders) const;
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
  bool stale = next.collisions != settings.collisions || next.seed != settings.seed ||
               next.firstOneOf != settings.firstOneOf;
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

/// The light's next pass takes one of so many points: as many as all passes before.
int VolumeSolver::Impl::nextOneOf(const LightField& field) const {
  const int doublings = std::clamp(field.passes - 1, 0, 30);
  return std::max(1, settings.firstOneOf >> doublings);
}

/// Of the light that has the fewest.
double VolumeSolver::Impl::wholePasses() const {
  double least = fields.empty() ? 0 : fields[0].wholePasses;
  for (const LightField& field : fields) least = std::min(least, field.wholePasses);
  return least;
}

void VolumeSolver::Impl::trace(LightField& field) {
  const auto start = std::chrono::steady_clock::now();
  const int oneOf = nextOneOf(field);
  Traced traced =
      traceLight(world, emission, field.light, settings.collisions, settings.seed, field.passes, oneOf);
  if (field.passes == 0) {
    field.entering = enteringFlux(world, field.light);
    for (int half : {0, 1}) field.deposits[half] = std::move(traced.deposits[half]);
    field.tally = traced.tally;
  } else {
    for (int half : {0, 1})
      for (size_t i = 0; i < world.bodies.size(); ++i)
        if (world.bodies[i]) field.deposits[half][i] += traced.deposits[half][i];
    field.tally += traced.tally;
  }
  ++field.passes;
  field.wholePasses += 1.0 / oneOf;
  stats.flights += traced.tally.flights;
  stats.rays += traced.tally.rays;
  stats.sourceMs += since(start);
}

/// An interruption leaves nothing half done: the light is to be made anew.
template <class Work>
void VolumeSolver::Impl::orForget(LightField& field, Work work) {
  try {
    work();
  } catch (...) {
    field = {};
    throw;
  }
}

/// Each half for itself; both together after the first pass, which is not judged by its halves.
void VolumeSolver::Impl::solveBody(LightField& field, size_t body, float each) {
  const DiffusionSystem& system = world.bodies[body]->system;
  std::vector<Lanes> Q[2] = {field.deposits[0][body].source, field.deposits[1][body].source};
  std::vector<Lanes>&phi = field.phi[0][body], &other = field.phi[1][body];
  for (size_t n = 0; n < Q[0].size(); ++n) {
    Q[0][n] *= each;
    Q[1][n] *= each;
    if (field.passes == 1) Q[0][n] = 0.5f * (Q[0][n] + Q[1][n]);
  }
  stats.iterations += system.solve(Q[0], phi, settings.tolerance).iterations;
  if (field.passes == 1)
    other = phi;
  else
    stats.iterations += system.solve(Q[1], other, settings.tolerance).iterations;
}

void VolumeSolver::Impl::solve(LightField& field) {
  const auto start = std::chrono::steady_clock::now();
  const size_t bodies = world.bodies.size();
  field.phiBack.resize(bodies);
  field.absorbed = field.tally.absorbed / field.wholePasses;
  const auto each = float(2 / field.wholePasses);
  for (int half : {0, 1}) {
    field.phi[half].resize(bodies);
    field.first[half].assign(bodies, {});
    field.multiple[half].assign(bodies, {});
  }
  for (size_t i = 0; i < bodies; ++i) {
    if (!world.bodies[i]) continue;
    solveBody(field, i, each);
    const DiffusionSystem& system = world.bodies[i]->system;
    for (int half : {0, 1}) {
      system.exits(field.phi[half][i], field.multiple[half][i]);
      field.first[half][i] = field.deposits[half][i].first;
      for (size_t n = 0; n < field.first[half][i].size(); ++n) {
        field.first[half][i][n] *= each;
        field.multiple[half][i][n] += field.deposits[half][i].later[n] * each;
      }
      field.absorbed += 0.5 * system.absorbed(field.phi[half][i]);
    }
  }
  stats.solveMs += since(start);
  exchangeLight(field);
}

/// Light that leaves and meets a surface again, once by tracing and a solve; what would go on the same way is
/// taken as a geometric series. It is little light: made anew when the passes have doubled.
void VolumeSolver::Impl::exchangeLight(LightField& field) {
  if (exchange->empty()) return;
  const auto start = std::chrono::steady_clock::now();
  if ((field.passes & (field.passes - 1)) == 0) field.again = lightThatReturns(field);
  for (auto& half : field.multiple)
    for (size_t i = 0; i < half.size(); ++i)
      for (size_t n = 0; n < half[i].size(); ++n) half[i][n] += field.again[i][n];
  stats.exchangeMs += since(start);
}

std::vector<std::vector<Lanes>> VolumeSolver::Impl::lightThatReturns(LightField& field) {
  std::vector<std::vector<Lanes>> leaving = field.multiple[0], result(leaving.size());
  for (size_t i = 0; i < leaving.size(); ++i)
    for (size_t n = 0; n < leaving[i].size(); ++n)
      leaving[i][n] = 0.5f * (field.multiple[0][i][n] + field.multiple[1][i][n] + field.first[0][i][n] +
                              field.first[1][i][n]);
  Tally tally;
  const int collisions = std::min(settings.collisions, kExchangeCollisions);
  const int oneOf = field.wholePasses < 1 ? kFewerReturn : 1;
  const std::vector<Deposits> back = exchange->send(world, leaving, collisions, settings.seed, oneOf, tally);
  for (size_t i = 0; i < back.size(); ++i) {
    if (!world.bodies[i]) continue;
    const DiffusionSystem& system = world.bodies[i]->system;
    std::vector<Lanes>& exits = result[i];
    stats.iterations +=
        system.solve(back[i].source, field.phiBack[i], std::max(0.03, settings.tolerance)).iterations;
    system.exits(field.phiBack[i], exits);
    Lanes before{0, 0, 0, 0}, after{0, 0, 0, 0};
    for (const Lanes& l : leaving[i]) before += l;
    for (size_t n = 0; n < exits.size(); ++n) after += exits[n] += back[i].later[n];
    Lanes series{1, 1, 1, 1};
    for (int c = 0; c < 3; ++c)
      if (before[c] > 0) series[c] = 1 / (1 - std::min(0.9f, after[c] / before[c]));
    for (Lanes& exit : exits) exit *= series;
  }
  return result;
}

NodeFlux VolumeSolver::Impl::flux(int object, Orders orders) const {
  const Body& body = *world.bodies[size_t(object)];
  const std::vector<Lanes> none(body.shape->surface.nodes().size(), Lanes{0, 0, 0, 0});
  NodeEstimate estimate{{none, none}, none};
  Lanes first{0, 0, 0, 0}, entering{0, 0, 0, 0};
  for (size_t l = 0; l < fields.size(); ++l) {
    const Rgb power = rays->lights()[l].power / double(body.size * body.size);
    const Lanes p{float(power.x), float(power.y), float(power.z), 0};
    const LightField& field = fields[l];
    for (size_t n = 0; n < none.size(); ++n) {
      for (int half : {0, 1}) {
        const Lanes one = p * field.first[half][size_t(object)][n];
        Lanes& sum = estimate.half[half][n];
        if (orders != Orders::kMultiple) sum += one;
        if (orders != Orders::kFirst) sum += p * field.multiple[half][size_t(object)][n];
        first += 0.5f * one;
      }
      estimate.entering[n] += p * field.entering[size_t(object)][n];
      entering += p * field.entering[size_t(object)][n];
    }
  }
  const double h = body.shape->grid.side();
  estimate.photons = settings.photons * wholePasses() * h * h / body.shape->surface.area();
  const auto response = [&](double q, int c) {
    const Diffusion& d = body.system.medium().channel[c];
    const double share = entering[c] > 0 ? double(first[c] / entering[c]) : 0;
    const double one = share * std::exp(-q / (h * d.sigma_tp)), all = std::max(one, d.response(q / h));
    return orders == Orders::kAll ? all : orders == Orders::kFirst ? one : all - one;
  };
  for (const LightField& field : fields)
    if (field.passes < 2) return cleanedQuickly(body.shape->smoother, estimate, response);
  return cleaned(body.shape->smoother, body.shape->surface, estimate, response);
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
    const Rgb each = power / field.wholePasses;
    stats.passes = l == 0 ? field.passes : std::min(stats.passes, field.passes);
    entered += field.tally.entered * each;
    left += field.tally.left * each;
    unscattered += field.tally.unscattered * each;
    lost += field.tally.lost * each;
    absorbed += field.absorbed * power;
    for (const auto& phi : field.phi)
      for (size_t i = 0; i < phi.size(); ++i) {
        if (!world.bodies[i]) continue;
        std::vector<Lanes> exits;
        world.bodies[i]->system.exits(phi[i], exits);
        for (const Lanes& e : exits) left += 0.5 * Rgb(e[0], e[1], e[2]) * power;
      }
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
    rays.reset();
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
  requireRange(settings.firstOneOf, 1, 256, "firstOneOf");
  Impl& all = *impl_;
  all.stats = {};
  const auto start = std::chrono::steady_clock::now();
  const bool stale = all.makeOrForgetBodies(scene, settings, progress);
  all.stats.geometryMs = since(start);
  const auto& lights = all.rays->lights();
  all.fields.resize(lights.size());
  if (stale)
    for (LightField& field : all.fields) field.passes = 0;
  for (size_t l = 0; l < lights.size(); ++l) {
    LightField& field = all.fields[l];
    const Interruptible inside(progress, {"volume: light", double(l) / double(lights.size()), ""});
    if (field.passes > 0 && sameRays(field.light, lights[l])) continue;
    field.light = lights[l];
    field.passes = 0;
    field.wholePasses = 0;
    all.trace(field);
    all.orForget(field, [&] { all.solve(field); });
  }
  all.tell();
}

void VolumeSolver::refine(const Progress& progress) {
  impl_->stats.sourceMs = impl_->stats.solveMs = impl_->stats.exchangeMs = 0;
  impl_->stats.iterations = 0;
  for (LightField& field : impl_->fields) {
    const Interruptible inside(progress, {"volume: light", 0, ""});
    impl_->trace(field);
    impl_->orForget(field, [&] { impl_->solve(field); });
  }
  impl_->tell();
}

std::vector<glm::vec3> VolumeSolver::vertexRadiosity(int object, Orders orders) const {
  auto& gather = impl_->gathers[size_t(object)];
  if (!gather) gather = std::make_unique<Gather>(*impl_->world.bodies[size_t(object)]->shape);
  return gather->vertices(impl_->flux(object, orders).flux);
}

double VolumeSolver::noise() const {
  if (impl_->stats.passes < 2) return 0;
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

Image VolumeSolver::picture(const RenderSettings& settings, const Progress& progress) const {
  NodeLight light;
  for (size_t i = 0; i < impl_->world.bodies.size(); ++i) {
    for (auto* part : {&light.all, &light.multiple, &light.error}) part->emplace_back();
    if (!impl_->world.bodies[i]) continue;
    const bool error = settings.wants("stderr");
    if (settings.wants("radiosity")) light.all.back() = impl_->flux(int(i), Orders::kAll).flux;
    if (!settings.components.multiple && !error) continue;
    NodeFlux multiple = impl_->flux(int(i), Orders::kMultiple);
    light.multiple.back() = std::move(multiple.flux);
    light.error.back() = std::move(multiple.variance);
    for (Lanes& e : light.error.back())
      for (int c = 0; c < 3; ++c) e[c] = std::sqrt(e[c]);
  }
  return volumePicture(*impl_->rays, impl_->world, light, settings, progress);
}

/// Passes of photons as asked for: a number, or until the noise or the time is up.
void VolumeSolver::Impl::converge(VolumeSolver& solver, const RenderSettings& wish,
                                  const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const bool openEnded = wish.noise > 0 || wish.timeLimit > 0;
  const int most = openEnded ? kMostPasses : wish.passes;
  int look = 2;  // the noise is a part of a pass's work to tell
  while (stats.passes > 0 && stats.passes < most) {
    if (wish.timeLimit > 0 && since(start) >= 1000 * wish.timeLimit) return;
    if (wish.noise > 0 && stats.passes >= look) {
      const double ratio = solver.noise() / wish.noise;
      if (ratio <= 1) return;
      look = stats.passes + int(std::clamp(stats.passes * (ratio * ratio - 1), 1.0, double(stats.passes)));
    }
    solver.refine(progress);
  }
}

Image VolumeSolver::render(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  tbb::task_arena arena(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic);
  return arena.execute([&] {
    const auto start = std::chrono::steady_clock::now();
    update(scene, {.cells = settings.cells, .collisions = settings.collisions, .seed = settings.seed},
           progress);
    impl_->converge(*this, settings, progress);
    Image image = picture(settings, progress);
    tellStats(impl_->stats, image);
    if (impl_->stats.passes > 1) image.metadata["noise"] = fmt::format("{:.6g}", noise());
    image.metadata["seconds"] = fmt::format("{:.3f}", since(start) / 1000);
    return image;
  });
}

const VolumeStats& VolumeSolver::stats() const {
  return impl_->stats;
}

}  // namespace lychnite
