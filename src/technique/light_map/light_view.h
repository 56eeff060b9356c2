#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "gpu/program.h"
#include "technique/frame.h"
#include "technique/key.h"

namespace lychnite {

/// The light-space map's view of one object, in scene units. Double-precision twin of
/// shaders/lib/light_map.glsl.
struct LightView {
  glm::dvec3 origin{0}, right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
  double halfWidth = 1;  ///< orthographic: half the window; perspective: tangent of half its angle
  bool perspective = false;
  double nearDepth = 0, farDepth = 1;  ///< of all that must be drawn, occluders included
  double centreDepth = 0;              ///< of the object's bounding sphere
  double backgroundDepth = 1;          ///< what an empty texel holds: just behind the object
  Rgb power{0};                        ///< irradiance E0, or intensity

  glm::dvec3 project(const glm::dvec3& p) const;  ///< (u, v, depth)
  glm::dvec3 unproject(const glm::dvec2& uv, double depth) const;
  glm::dvec3 travel(const glm::dvec3& p) const;                ///< unit direction of the light at p
  double windowArea(const glm::dvec3& p, double depth) const;  ///< across the light, at depth

  glm::dmat4 toClip() const;
  void setUniforms(gpu::Program& program) const;
  Key key() const;
};

/// Fits a view to objects[target]: its bounding sphere for parallel light and for a point far enough away (so
/// that the window neither breathes nor turns with the light), its vertices for a point close by. Throws
/// Error (Kind::kUsage) for a point light that no single perspective view can hold.
LightView fitLightView(const Frame& frame, size_t target, size_t light);

}  // namespace lychnite
