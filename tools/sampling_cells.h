#pragma once

// The pictures that docs/sampling.md judges samplers by: a model in a material, at six sizes, in three
// lights.
#include <algorithm>
#include <string>

#include "lychnite/image/image.h"
#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene.h"
#include "lychnite/scene/settings.h"

namespace lychnite::sampling {

inline constexpr double kSizes[] = {1, 3, 10, 30, 100, 300};  // mm

struct NamedLight {
  const char* name;
  ParallelLight light;
};
inline constexpr NamedLight kLights[] = {{"front", {.azimuth = -30, .elevation = 40}},
                                         {"side", {.azimuth = 80, .elevation = 10}},
                                         {"behind", {.azimuth = 150, .elevation = 25}}};

inline Scene sceneOf(const Object& object, const std::string& material, double size,
                     const ParallelLight& light) {
  Scene scene;
  scene.objects = {object};
  scene.objects[0].size = size;
  scene.objects[0].material.medium = findMaterial(material, "").coefficients;
  scene.lights = {light};
  return scene;
}

/// Multiple scattering alone.
inline RenderSettings settingsOf(Method method, int samples = 32) {
  RenderSettings settings;
  settings.width = settings.height = 96;
  settings.method = method;
  settings.multipleSamples = samples;
  settings.components = {.multiple = true, .single = false, .surface = false};
  return settings;
}

/// A flat thing lit from behind and too thick: no picture, no relative error.
inline bool isBlack(const Image& image) {
  const auto& red = image.channel("R");
  return std::all_of(red.begin(), red.end(), [](float v) { return v == 0; });
}

}  // namespace lychnite::sampling
