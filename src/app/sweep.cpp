#include "lychnite/app/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

const Object& subject(const Scene& scene) {
  const auto found = std::find_if(scene.objects.begin(), scene.objects.end(),
                                  [](const Object& object) { return !object.material.opaque; });
  return found != scene.objects.end() ? *found : scene.objects.front();
}

void turnObjects(Scene& scene, double degrees) {
  const glm::dquat turn = glm::angleAxis(degrees * std::numbers::pi / 180, glm::dvec3(0, 1, 0));
  for (Object& object : scene.objects) {
    object.position = turn * object.position;
    object.rotation = glm::normalize(turn * object.rotation);
  }
}

}  // namespace

void validate(const Sweep& sweep) {
  const auto refuse = [](std::string where, std::string expected, std::string found) {
    throw Error(
        {.where = std::move(where), .expected = std::move(expected), .found = std::move(found), .todo = ""},
        Error::Kind::kUsage);
  };
  if (sweep.frames < 1 || sweep.frames > 1'000'000)
    refuse("frames", "1 to 1000000", std::to_string(sweep.frames));
  if (sweep.sizeFrom.has_value() != sweep.sizeTo.has_value())
    refuse("size sweep", "both --size-from and --size-to", "one of them");
  for (const auto& size : {sweep.sizeFrom, sweep.sizeTo})
    if (size && !(*size > 0)) refuse("size sweep", "lengths above zero", fmt::format("{} mm", *size));
}

Scene scaledScene(const Scene& scene, double factor) {
  Scene result = scene;
  for (Object& object : result.objects) {
    object.size *= factor;
    object.position *= factor;
  }
  for (Light& light : result.lights) {
    if (auto* point = std::get_if<PointLight>(&light)) {
      point->position *= factor;
      point->intensity *= factor * factor;
    }
  }
  if (auto* pinhole = std::get_if<PinholeCamera>(&result.camera)) {
    pinhole->position *= factor;
    pinhole->target *= factor;
  }
  return result;
}

Scene sceneAt(const Scene& scene, const Sweep& sweep, int index) {
  Scene result = scene;
  const double turned = double(index) / sweep.frames;
  for (Light& light : result.lights)
    if (auto* parallel = std::get_if<ParallelLight>(&light))
      parallel->azimuth += sweep.orbitLightDegrees * turned;
  if (sweep.turntableDegrees != 0) turnObjects(result, sweep.turntableDegrees * turned);
  if (!sweep.sizeFrom || scene.objects.empty()) return result;
  const double t = sweep.frames > 1 ? double(index) / (sweep.frames - 1) : 0;
  const double size = *sweep.sizeFrom * std::pow(*sweep.sizeTo / *sweep.sizeFrom, t);
  return scaledScene(result, size / subject(scene).size);
}

std::filesystem::path numbered(const std::filesystem::path& path, int index, int frames) {
  const int digits = std::max(4, int(std::to_string(frames).size()));
  return path.parent_path() /
         fmt::format("{}_{:0{}}{}", path.stem().string(), index + 1, digits, path.extension().string());
}

}  // namespace lychnite
