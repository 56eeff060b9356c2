#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "lychnite/mesh/load.h"
#include "lychnite/optics/fresnel.h"
#include "reference/walk_photon.h"

namespace lychnite {

namespace {

/// How finely the distance grid follows the surface: about two cells a mean free path, within reason.
int gridCells(const transport::Medium& medium) {
  const float sigma = std::max({medium.sigma_t.x, medium.sigma_t.y, medium.sigma_t.z});
  return std::clamp(int(4 * sigma), 32, 160);
}

void addObject(const RayScene& rays, int object, const LogSink& log, WalkWorld& world) {
  const Object& source = rays.scene().objects[size_t(object)];
  world.media.emplace_back(rays.medium(object));
  world.lobeScale.push_back(
      float(1 / (std::numbers::pi * diffuseTransmittanceOutside(source.material.medium.eta))));
  world.closed.push_back(1);
  world.distance.push_back(nullptr);
  if (rays.opaque(object)) return;
  world.distance.back() = std::make_unique<WalkDistance>(rays, object, gridCells(world.media.back()));
  world.closed.back() = inspect(*source.mesh).closed ? 1 : 0;
  if (!world.closed.back())
    logTo(log, LogLevel::kWarning,
          fmt::format(
              "walk: the mesh of {} is not closed, so its inside is undefined; light that meets a hole or a "
              "wall from behind is lost (metadata 'lost' says how much)",
              source.name.empty() ? source.model : source.name));
}

}  // namespace

WalkWorld makeWalkWorld(const RayScene& rays, const WalkEmission& emission, const LogSink& log) {
  WalkWorld world;
  world.rays = &rays;
  world.emission = &emission;
  world.fluxUnit = float(std::max(emission.power(), 1e-30));
  for (int object = 0; object < int(rays.objectCount()); ++object) addObject(rays, object, log, world);
  return world;
}

}  // namespace lychnite
