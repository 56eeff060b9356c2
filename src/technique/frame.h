#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <vector>

#include "lychnite/scene/scene.h"

namespace lychnite {

/// An object in scene units.
struct FrameObject {
  const Object* source = nullptr;
  uint64_t mesh = 0;      ///< MeshCache's number of the mesh, never used twice
  glm::dmat4 toWorld{1};  ///< mesh to scene units
  glm::mat3 normalToWorld{1};
  Sphere bounds;        ///< scene units
  Coefficients medium;  ///< per scene unit
  bool translucent = true;
};

/// A scene with its lengths divided by `unit` and its centre moved to 0. All that the GPU sees is in these
/// units, so that a scene scaled together with its coefficients gives the same numbers, and single precision
/// is used well.
struct Frame {
  double unit = 1;  ///< mm
  glm::dvec3 origin{0};
  std::vector<FrameObject> objects;
  std::vector<Light> lights;  ///< positions in scene units, intensities for them
  CameraFrame camera;         ///< scene units
  glm::dmat4 toClip{1};       ///< scene units to the camera's clip space
};

Frame makeFrame(const Scene& scene, int width, int height);

}  // namespace lychnite
