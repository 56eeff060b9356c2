#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <string>

#include "lychnite/mesh/builtin.h"
#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene.h"
#include "lychnite/scene/settings.h"
#include "reference/dipole.h"

namespace lychnite::test {

inline Object object(std::shared_ptr<const Mesh> mesh, const std::string& material, double size) {
  Object result;
  result.mesh = std::move(mesh);
  result.material.medium = findMaterial(material, "test").coefficients;
  result.size = size;
  return result;
}

/// A built-in model lit by one parallel light.
inline Scene litScene(const std::string& model, const std::string& material, double size, double azimuth) {
  Scene scene;
  scene.objects = {object(builtinMesh(model), material, size)};
  scene.lights = {ParallelLight{.azimuth = azimuth, .elevation = 25}};
  return scene;
}

inline RenderSettings picture(int resolution, double tolerance = 0.005) {
  RenderSettings settings;
  settings.width = settings.height = resolution;
  settings.tolerance = tolerance;
  settings.method = Method::kDipole;
  return settings;
}

/// A unit sphere of 2 n n triangles, fine enough to count as round.
inline std::shared_ptr<const Mesh> fineSphere(uint32_t n) {
  Mesh mesh;
  for (uint32_t i = 0; i <= n; ++i)
    for (uint32_t j = 0; j < 2 * n; ++j) {
      const double theta = std::numbers::pi * i / n, phi = std::numbers::pi * j / n;
      mesh.positions.emplace_back(std::sin(theta) * std::sin(phi), std::cos(theta),
                                  std::sin(theta) * std::cos(phi));
    }
  for (uint32_t i = 0; i < n; ++i)
    for (uint32_t j = 0; j < 2 * n; ++j) {
      const uint32_t a = i * 2 * n + j, b = i * 2 * n + (j + 1) % (2 * n);
      if (i > 0) mesh.triangles.emplace_back(a, b + 2 * n, b);
      if (i + 1 < n) mesh.triangles.emplace_back(a, a + 2 * n, b + 2 * n);
    }
  mesh.normals = mesh.positions;
  return std::make_shared<Mesh>(std::move(mesh));
}

/// Relative RMSE of a against b over the receivers, all channels together.
inline double relativeError(const DiffusionSum& a, const DiffusionSum& b, const CameraReceivers& receivers) {
  double squares = 0, mean = 0, weights = 0;
  for (size_t i = 0; i < a.radiosity.size(); ++i) {
    const double weight = receivers.receivers[i].weight;
    const glm::dvec3 x(a.radiosity[i]), y(b.radiosity[i]);
    squares += weight * glm::dot(x - y, x - y);
    mean += weight * (y.x + y.y + y.z);
    weights += 3 * weight;
  }
  return std::sqrt(squares / weights) / (mean / weights);
}

}  // namespace lychnite::test
