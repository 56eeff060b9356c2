#pragma once

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include "lychnite/image/image.h"
#include "lychnite/scene/scene.h"
#include "lychnite/scene/settings.h"

/// What the tests of the walk are made of.
namespace lychnite {

constexpr double kSigmas = 4;

inline Object translucent(std::shared_ptr<const Mesh> mesh, double size, const Coefficients& medium) {
  Object object;
  object.mesh = std::move(mesh);
  object.model = "test";
  object.material.medium = medium;
  object.size = size;
  return object;
}

inline Scene sceneOf(const Object& object) {
  Scene scene;
  scene.objects.push_back(object);
  scene.lights.push_back(ParallelLight{.azimuth = 150, .elevation = 20});
  return scene;
}

inline RenderSettings walkSettings(int resolution, double samples) {
  RenderSettings settings;
  settings.method = Method::kWalk;
  settings.width = settings.height = resolution;
  settings.samples = samples;
  settings.components = {.multiple = true, .single = false, .surface = false};
  return settings;
}

/// The numbers of a metadata entry, one per channel.
inline Rgb share(const Image& image, const std::string& name) {
  const char* text = image.metadata.at(name).c_str();
  Rgb value;
  for (int c = 0; c < 3; ++c) {
    char* end = nullptr;
    value[c] = std::strtod(text, &end);
    text = end;
  }
  return value;
}

/// Mean of a layer over the pixels of a centred square of `part` of the picture's width.
inline Rgb middle(const Image& image, const std::string& layer, double part = 1) {
  Rgb sum(0);
  double count = 0;
  const double half = part / 2;
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    const double x = (double(i % size_t(image.width())) + 0.5) / image.width() - 0.5;
    const double y = (double(i / size_t(image.width())) + 0.5) / image.height() - 0.5;
    if (std::abs(x) > half || std::abs(y) > half) continue;
    sum += Rgb(image.rgb(i, layer));
    count += 1;
  }
  return sum / count;
}

/// Mean and standard error over independent seeds.
template <class Estimate>
std::pair<Rgb, Rgb> overSeeds(int seeds, Estimate estimate) {
  Rgb sum(0), squares(0);
  for (int seed = 1; seed <= seeds; ++seed) {
    const Rgb value = estimate(uint64_t(seed));
    sum += value;
    squares += value * value;
  }
  const Rgb mean = sum / double(seeds);
  return {mean, glm::sqrt(glm::max(squares / double(seeds) - mean * mean, Rgb(0)) / double(seeds - 1))};
}

/// A box of the given half sides, twelve triangles.
inline std::shared_ptr<const Mesh> boxMesh(const glm::vec3& half) {
  auto mesh = std::make_shared<Mesh>();
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto first = uint32_t(mesh->positions.size());
      glm::vec3 normal(0);
      normal[axis] = sign;
      for (int corner = 0; corner < 4; ++corner) {
        glm::vec3 p;
        p[axis] = sign * half[axis];
        p[u] = (corner == 1 || corner == 2 ? 1.0f : -1.0f) * half[u];
        p[v] = (corner >= 2 ? 1.0f : -1.0f) * half[v];
        mesh->positions.push_back(p);
        mesh->normals.push_back(normal);
      }
      if (sign > 0) {
        mesh->triangles.push_back({first, first + 1, first + 2});
        mesh->triangles.push_back({first, first + 2, first + 3});
      } else {
        mesh->triangles.push_back({first, first + 2, first + 1});
        mesh->triangles.push_back({first, first + 3, first + 2});
      }
    }
  return mesh;
}

/// A camera along z, straight onto the middle of a face.
inline Scene slabScene(const Coefficients& medium, double side, double thickness, bool litSide) {
  Scene scene = sceneOf(translucent(boxMesh(glm::vec3(side / 2, side / 2, thickness / 2)), side, medium));
  scene.lights = {ParallelLight{.azimuth = 0, .elevation = 0, .irradiance = Rgb(1)}};
  const double away = litSide ? 300 : -300;
  scene.camera = PinholeCamera{.position = {0, 0, away}, .target = {0, 0, 0}, .fov = 2.3};  // sees 12 mm
  return scene;
}

}  // namespace lychnite
