#pragma once

#include <glm/gtc/quaternion.hpp>
#include <memory>

#include "reference/ray_scene.h"
#include "reference/transport.h"
#include "volume/diffusion.h"
#include "volume/slab_transport.h"
#include "volume/smooth.h"

namespace lychnite::volume {

/// All that depends on a mesh and the number of cells only; shared by all objects and scenes that show it.
struct Shape {
  Shape(std::shared_ptr<const Mesh> source, int cells);
  std::shared_ptr<const Mesh> mesh;
  LocalMesh local;
  Grid grid;
  Surface surface;
  Smoother smoother;
  size_t memoryBytes() const { return grid.memoryBytes() + surface.memoryBytes() + smoother.memoryBytes(); }
};

/// A translucent object of a scene: a shape at its place, with its medium.
struct Body {
  Body(std::shared_ptr<const Shape> which, const RayScene& rays, int object, bool alone);

  glm::vec3 toLocal(const glm::vec3& p) const { return (turnBack * (p - position)) / size; }
  glm::vec3 toScene(const glm::vec3& p) const { return position + glm::inverse(turnBack) * (size * p); }
  /// Distance that light at p is surely in this medium, scene units.
  float clear(const glm::vec3& p) const { return trustClear ? shape->grid.clear(toLocal(p)) * size : 0; }

  std::shared_ptr<const Shape> shape;
  glm::vec3 position{0};  ///< scene units
  glm::quat turnBack{1, 0, 0, 0};
  float size = 1;             ///< longest side, scene units
  transport::Medium medium;   ///< per scene unit
  transport::Medium reduced;  ///< isotropic with sigma_sp, per scene unit
  DiffusionSystem system;     ///< local units
  glm::vec3 chances{1};       ///< of the channels, to draw a path: 1 together
  SlabTransport slabs[3];     ///< of the reduced medium's channels
  float thickness = 1;        ///< of the slab that has as much volume for its surface, local units
  bool trustClear = true;     ///< nothing else can be inside
};

}  // namespace lychnite::volume
