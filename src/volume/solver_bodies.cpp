#include <fmt/format.h>

#include "lychnite/base/error.h"
#include "volume/interruptible.h"
#include "volume/solver.h"

namespace lychnite {

using namespace volume;

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
  for (size_t i = 0; i < rays->objectCount(); ++i) {
    world.bodies.emplace_back();
    if (!rays->opaque(int(i))) {
      const auto shape = shapeOf(scene.objects[i].mesh);
      used[shape->mesh.get()] = shape;
      world.bodies.back() = std::make_unique<Body>(shape, *rays, int(i), rays->objectCount() == 1);
    }
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

/// From inside nothing is lit: surfaces face outwards.
void VolumeSolver::Impl::refuseLightsInside() const {
  for (size_t l = 0; l < rays->lights().size(); ++l) {
    const RayLight& light = rays->lights()[l];
    if (light.parallel) continue;
    for (size_t i = 0; i < world.bodies.size(); ++i)
      if (world.bodies[i] && world.bodies[i]->shape->grid.find(
                                 world.bodies[i]->toLocal(glm::vec3(light.position))) != Grid::kNone)
        throw Error({.where = fmt::format("light {}", l + 1),
                     .expected = "a point light outside all objects",
                     .found = fmt::format("one inside object {}", i + 1),
                     .todo = "move it out"},
                    Error::Kind::kUsage);
  }
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

}  // namespace lychnite
