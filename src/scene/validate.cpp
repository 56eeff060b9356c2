#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "lychnite/base/error.h"
#include "lychnite/scene/scene.h"

namespace lychnite {
namespace {

[[noreturn]] void refuse(std::string where, std::string expected, std::string found) {
  throw Error(
      {.where = std::move(where), .expected = std::move(expected), .found = std::move(found), .todo = ""},
      Error::Kind::kUsage);
}

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void requireRange(double value, double low, double high, const std::string& where) {
  if (!(value >= low && value <= high))
    refuse(where, fmt::format("a number from {} to {}", low, high), fmt::format("{}", value));
}

void requireFinite(const glm::dvec3& v, const std::string& where) {
  if (!finite(v)) refuse(where, "finite numbers", fmt::format("{}, {}, {}", v.x, v.y, v.z));
}

void requireRadiance(const Rgb& value, const std::string& where) {
  if (!finite(value) || value.x < 0 || value.y < 0 || value.z < 0)
    refuse(where, "three finite numbers of 0 or more", fmt::format("{}, {}, {}", value.x, value.y, value.z));
}

void checkObject(const Object& object, const std::string& where) {
  if (!object.mesh || object.mesh->triangles.empty()) refuse(where, "a mesh with triangles", "none");
  if (!(object.size > 0) || !std::isfinite(object.size))
    refuse(where + " size", "a length above zero", fmt::format("{} mm", object.size));
  // Far outside of what single precision and any material can mean, and still generous.
  requireRange(object.size, 1e-6, 1e9, where + " size (mm)");
  requireFinite(object.position, where + " position");
  const glm::dquat& q = object.rotation;
  if (!(std::abs(glm::length(q) - 1) < 1e-6)) refuse(where + " rotation", "a unit quaternion", "another");
  const Material& material = object.material;
  validate(material.medium, where + " material");
  requireRange(material.roughness, 0.02, 1, where + " roughness");
  for (int c = 0; c < 3; ++c) requireRange(material.colour[c], 0, 1, where + " colour");
}

void checkLight(const Light& light, const std::string& where) {
  if (const auto* parallel = std::get_if<ParallelLight>(&light)) {
    requireFinite({parallel->azimuth, parallel->elevation, 0}, where + " angles");
    requireRadiance(parallel->irradiance, where + " irradiance");
  } else {
    const auto& point = std::get<PointLight>(light);
    requireFinite(point.position, where + " position");
    requireRadiance(point.intensity, where + " intensity");
  }
}

void checkCamera(const Camera& camera) {
  if (const auto* orbit = std::get_if<OrbitCamera>(&camera)) {
    requireFinite({orbit->azimuth, orbit->elevation, 0}, "camera angles");
    requireRange(orbit->factor, 1e-3, 1e6, "camera factor");
    requireRange(orbit->fov, 0.01, 170, "camera fov (degrees)");
    return;
  }
  const auto& pinhole = std::get<PinholeCamera>(camera);
  requireFinite(pinhole.position, "camera position");
  requireFinite(pinhole.target, "camera target");
  requireFinite(pinhole.up, "camera up");
  requireRange(pinhole.fov, 0.01, 170, "camera fov (degrees)");
  if (glm::distance(pinhole.position, pinhole.target) == 0)
    refuse("camera", "a target away from its position", "both the same");
  if (glm::length(pinhole.up) == 0) refuse("camera up", "a direction", "0, 0, 0");
}

std::string nameOf(const Object& object, size_t index) {
  if (!object.name.empty()) return fmt::format("object '{}'", object.name);
  if (!object.model.empty()) return fmt::format("object '{}'", object.model);
  return fmt::format("object {}", index + 1);
}

}  // namespace

void validate(const Scene& scene) {
  if (scene.objects.empty()) refuse("scene", "at least one object", "none");
  // The light-space passes store an object's number in a float beside its normal; 250 is far below where that
  // ends.
  if (scene.objects.size() > 250)
    refuse("scene", "at most 250 objects", fmt::format("{}", scene.objects.size()));
  if (scene.lights.size() > 64) refuse("scene", "at most 64 lights", fmt::format("{}", scene.lights.size()));
  for (size_t i = 0; i < scene.objects.size(); ++i)
    checkObject(scene.objects[i], nameOf(scene.objects[i], i));
  for (size_t i = 0; i < scene.lights.size(); ++i)
    checkLight(scene.lights[i], fmt::format("light {}", i + 1));
  checkCamera(scene.camera);
  requireRadiance(scene.background, "background");
  requireRadiance(scene.ambient, "ambient");
}

}  // namespace lychnite
