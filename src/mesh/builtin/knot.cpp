#include "mesh/builtin/models.h"
#include "mesh/builtin/portable_trig.h"
#include "mesh/builtin/surface.h"

#include <glm/geometric.hpp>

namespace lychnite::builtin {
namespace {

constexpr double kRing = 1.0, kSwing = 0.45, kTube = 0.26;  ///< of the torus the knot winds on, and the tube

/// The (2, 3) torus knot, a trefoil: twice around the z axis, three times through the hole; a lobe points up.
glm::dvec3 knotPoint(double turns) {
  const CirclePoint around = circlePoint(2 * turns), through = circlePoint(3 * turns);
  const double r = kRing + kSwing * through.cos;
  return {-r * around.sin, r * around.cos, kSwing * through.sin};
}

/// The torus' normal there, which is across the knot and comes back to itself.
glm::dvec3 torusNormal(double turns) {
  const CirclePoint around = circlePoint(2 * turns), through = circlePoint(3 * turns);
  return {-through.cos * around.sin, through.cos * around.cos, through.sin};
}

}  // namespace

Mesh makeKnot() {
  constexpr unsigned kAlong = 480, kAcross = 32;
  Surface s;
  for (unsigned i = 0; i < kAlong; ++i) {
    const double t = double(i) / kAlong, dt = 0.25 / kAlong;
    const glm::dvec3 tangent = glm::normalize(knotPoint(t + dt) - knotPoint(t - dt));
    const glm::dvec3 normal = torusNormal(t), side = glm::cross(tangent, normal);
    for (unsigned j = 0; j < kAcross; ++j) {
      const CirclePoint c = circlePoint(double(j) / kAcross);
      s.positions.push_back(knotPoint(t) + kTube * (c.cos * normal + c.sin * side));
    }
  }
  const auto vertex = [](unsigned i, unsigned j) { return i % kAlong * kAcross + j % kAcross; };
  for (unsigned i = 0; i < kAlong; ++i)
    for (unsigned j = 0; j < kAcross; ++j)
      s.addQuad(vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j));
  return finishMesh(s);
}

}  // namespace lychnite::builtin
