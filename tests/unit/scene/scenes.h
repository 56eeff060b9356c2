#pragma once

#include "lychnite/mesh/builtin.h"
#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene.h"

namespace lychnite {

/// A built-in model of a library material.
inline Object makeObject(const std::string& model, double size, const std::string& material = "marble") {
  Object object;
  object.model = model;
  object.mesh = builtinMesh(model);
  object.size = size;
  object.material.name = material;
  object.material.medium = findMaterial(material, "").coefficients;
  return object;
}

inline Scene oneObject(const std::string& model, double size, const std::string& material = "marble") {
  Scene scene;
  scene.objects.push_back(makeObject(model, size, material));
  scene.lights.push_back(ParallelLight{});
  return scene;
}

}  // namespace lychnite
