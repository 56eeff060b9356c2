#include "volume/body.h"

#include <glm/common.hpp>

namespace lychnite::volume {

namespace {

constexpr float kLeastChance = 0.05f;  // of a channel, before they are made 1 together

Coefficients reducedOf(const Coefficients& medium) {
  Coefficients result = medium;
  result.sigma_s = medium.sigma_sp();
  result.g = 0;
  return result;
}

/// Paths are drawn for the channels that light comes back in, which goes with some power of the albedo; the
/// others take part by weights.
glm::vec3 chancesOf(const transport::Medium& medium) {
  const glm::vec3 albedo = medium.sigma_s / glm::max(medium.sigma_t, glm::vec3(1e-20f));
  const glm::vec3 share = glm::max(albedo * albedo, glm::vec3(kLeastChance));
  return share / (share.x + share.y + share.z);
}

}  // namespace

Shape::Shape(std::shared_ptr<const Mesh> source, int cells)
    : mesh(std::move(source)),
      local(*mesh),
      grid(local, cells),
      surface(local, grid),
      smoother(grid, surface) {}

Body::Body(std::shared_ptr<const Shape> which, const RayScene& rays, int object, bool alone)
    : shape(std::move(which)),
      position(rays.toUnits(rays.scene().objects[size_t(object)].position)),
      turnBack(glm::inverse(glm::quat(rays.scene().objects[size_t(object)].rotation))),
      size(float(rays.scene().objects[size_t(object)].size / rays.unit())),
      medium(rays.medium(object)),
      reduced(reducedOf(rays.medium(object))),
      system(shape->grid, shape->surface,
             DiffusionRgb(rays.scene().objects[size_t(object)].material.medium.scaled(
                 1 / rays.scene().objects[size_t(object)].size))),
      trustClear(alone) {
  for (int c = 0; c < 3; ++c) slabs[c] = SlabTransport(system.medium().channel[c], double(medium.eta));
  chances = chancesOf(reduced);
  double volume = 0;
  for (size_t i = 0; i < shape->grid.size(); ++i) volume += double(shape->grid.cell(i).volume);
  thickness = float(2 * volume / std::max(1e-12, shape->surface.area()));
}

}  // namespace lychnite::volume
