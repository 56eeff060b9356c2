#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numbers>

#include "volume/solver.h"

namespace lychnite {

using namespace volume;

namespace {

/// An empty `from` is 0.
void addScaled(const std::vector<Lanes>& from, const Lanes& scale, std::vector<Lanes>& to) {
  for (size_t n = 0; n < from.size(); ++n) to[n] += scale * from[n];
}

}  // namespace

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
  result.photons = photonDensity(object) * h * h;
  return result;
}

/// Starting points of all passes per area, local units, where the light comes in that counts; of the light
/// that has the fewest.
double VolumeSolver::Impl::photonDensity(size_t object) const {
  if (passes() < 1) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const LightField& field : fields) least = std::min(least, field.density[object]);
  return least;
}

FirstOrder VolumeSolver::Impl::firstOrder(size_t object, const std::vector<Lanes>& entering) const {
  const Body& body = *world.bodies[object];
  const std::vector<Lanes> none(entering.size(), Lanes{0, 0, 0, 0});
  FirstOrder first{none, {}, {}};
  const bool photons = passes() > 0;
  if (photons) first.half[0] = first.half[1] = none;
  forLights(object, [&](const LightField& field, const Lanes& p) {
    addScaled(field.beamFirst[object], p, first.flux);
    for (int half : {0, 1})
      if (photons) addScaled(field.first[half][object], p, first.half[half]);
  });
  Lanes sum{0, 0, 0, 0}, all{0, 0, 0, 0};
  for (size_t n = 0; n < entering.size(); ++n) {
    sum += photons ? 0.5f * (first.half[0][n] + first.half[1][n]) : first.flux[n];
    all += entering[n];
  }
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
  if (orders == Orders::kFirst) return {cleanedFirst(smoother, body.shape->surface, known, first), {}};
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

std::vector<glm::vec3> VolumeSolver::vertexRadiosity(int object, Orders orders) const {
  auto& gather = impl_->gathers[size_t(object)];
  if (!gather) gather = std::make_unique<Gather>(*impl_->world.bodies[size_t(object)]->shape);
  return gather->vertices(impl_->flux(object, orders).flux);
}

std::vector<glm::vec3> VolumeSolver::pointRadiosity(int object, const std::vector<MeshPoint>& points,
                                                    Orders orders) const {
  const Shape& shape = *impl_->world.bodies[size_t(object)]->shape;
  const std::vector<Lanes> flux = impl_->flux(object, orders).flux;
  std::vector<glm::vec3> result(points.size());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, points.size()), [&](const auto& range) {
    std::vector<Gather::Weight> weights;
    for (size_t i = range.begin(); i < range.end(); ++i) {
      Gather::weigh(shape, points[i], weights);
      Lanes sum{0, 0, 0, 0};
      for (const Gather::Weight& w : weights) sum += w.weight * flux[w.node];
      result[i] = {sum[0], sum[1], sum[2]};
    }
  });
  return result;
}

/// By nodes, each weighted by how much of the picture it is that photons are aimed at, or by its area.
double VolumeSolver::noise() const {
  if (impl_->stats.passes < 1) return 0;
  double squares = 0, sum = 0, weights = 0;
  for (size_t i = 0; i < impl_->world.bodies.size(); ++i) {
    if (!impl_->world.bodies[i]) continue;
    const auto& nodes = impl_->world.bodies[i]->shape->surface.nodes();
    const NodeFlux light = impl_->flux(int(i), Orders::kAll);
    if (light.variance.empty()) return 0;
    for (size_t n = 0; n < nodes.size(); ++n) {
      if (!(nodes[n].area > 0)) continue;
      const auto area = double(nodes[n].area);
      const double weight = impl_->aim.seen.empty() ? area : double(impl_->aim.seen[i][n]);
      for (int c = 0; c < 3; ++c) {
        squares += weight * double(light.variance[n][c]) / (area * area);
        sum += weight * double(light.flux[n][c]) / area;
      }
      weights += 3 * weight;
    }
  }
  return sum > 0 ? std::sqrt(squares * weights) / sum : 0;
}

}  // namespace lychnite
