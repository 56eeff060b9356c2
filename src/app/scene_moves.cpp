#include "lychnite/app/scene_moves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "lychnite/app/sweep.h"
#include "lychnite/app/view_state.h"

namespace lychnite {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kSteepest = 89;

struct Angles {
  double azimuth = 0, elevation = 0, length = 0;
};

Angles anglesOf(const glm::dvec3& v) {
  const double length = glm::length(v);
  if (length == 0) return {};
  return {std::atan2(v.x, v.z) * kDegrees, std::asin(std::clamp(v.y / length, -1.0, 1.0)) * kDegrees, length};
}

double wrapped(double degrees) {
  return std::remainder(degrees, 360.0);
}

glm::dvec3 turned(const glm::dvec3& v, double azimuth, double elevation) {
  const Angles a = anglesOf(v);
  return a.length *
         directionFromAngles(a.azimuth + azimuth, std::clamp(a.elevation + elevation, -kSteepest, kSteepest));
}

Sphere subjectSphere(const Scene& scene) {
  const Sphere subject = boundingSphere(scene, true);
  return subject.radius > 0 ? subject : boundingSphere(scene);
}

}  // namespace

void orbitCamera(Scene& scene, double azimuth, double elevation) {
  if (auto* orbit = std::get_if<OrbitCamera>(&scene.camera)) {
    orbit->azimuth = wrapped(orbit->azimuth + azimuth);
    orbit->elevation = std::clamp(orbit->elevation + elevation, -kSteepest, kSteepest);
    return;
  }
  auto& pinhole = std::get<PinholeCamera>(scene.camera);
  pinhole.position = pinhole.target + turned(pinhole.position - pinhole.target, azimuth, elevation);
  pinhole.up = {0, 1, 0};
}

void zoomCamera(Scene& scene, double factor) {
  if (auto* orbit = std::get_if<OrbitCamera>(&scene.camera)) {
    orbit->factor = std::clamp(orbit->factor * factor, 0.05, 50.0);
    return;
  }
  auto& pinhole = std::get<PinholeCamera>(scene.camera);
  const double radius = subjectSphere(scene).radius;
  const glm::dvec3 away = pinhole.position - pinhole.target;
  const double distance = std::clamp(glm::length(away) * factor, 0.05 * radius, 500 * radius);
  pinhole.position = pinhole.target + glm::normalize(away) * distance;
}

void panCamera(Scene& scene, double x, double y) {
  const CameraFrame frame = cameraFrame(scene, 1, 1);
  if (const auto* orbit = std::get_if<OrbitCamera>(&scene.camera))
    scene.camera = PinholeCamera{.position = frame.position,
                                 .target = subjectSphere(scene).centre,
                                 .up = {0, 1, 0},
                                 .fov = orbit->fov};
  auto& pinhole = std::get<PinholeCamera>(scene.camera);
  const double height = 2 * frame.tanHalfFovY * glm::distance(pinhole.position, pinhole.target);
  const glm::dvec3 move = (frame.right * -x - frame.up * y) * height;
  pinhole.position += move;
  pinhole.target += move;
}

void fitCamera(Scene& scene) {
  OrbitCamera fitted{.factor = 1.15};
  if (const auto* orbit = std::get_if<OrbitCamera>(&scene.camera)) {
    fitted = *orbit;
    fitted.factor = 1.15;
  } else {
    const auto& pinhole = std::get<PinholeCamera>(scene.camera);
    const Angles angles = anglesOf(pinhole.position - pinhole.target);
    fitted.azimuth = angles.azimuth;
    fitted.elevation = std::clamp(angles.elevation, -kSteepest, kSteepest);
    fitted.fov = pinhole.fov;
  }
  scene.camera = fitted;
}

void setView(Scene& scene, int number) {
  static constexpr std::array<std::array<double, 2>, 9> kViews{
      {{0, 0}, {90, 0}, {180, 0}, {-90, 0}, {0, kSteepest}, {0, -kSteepest}, {35, 25}, {-35, 25}, {145, 25}}};
  if (number < 1 || number > int(kViews.size())) return;
  fitCamera(scene);
  auto& orbit = std::get<OrbitCamera>(scene.camera);
  orbit.azimuth = kViews[size_t(number - 1)][0];
  orbit.elevation = kViews[size_t(number - 1)][1];
}

void turnLight(Scene& scene, size_t light, double azimuth, double elevation) {
  if (light >= scene.lights.size()) return;
  if (auto* parallel = std::get_if<ParallelLight>(&scene.lights[light])) {
    parallel->azimuth = wrapped(parallel->azimuth + azimuth);
    parallel->elevation = std::clamp(parallel->elevation + elevation, -kSteepest, kSteepest);
    return;
  }
  auto& point = std::get<PointLight>(scene.lights[light]);
  const glm::dvec3 centre = subjectSphere(scene).centre;
  point.position = centre + turned(point.position - centre, azimuth, elevation);
}

void turnLights(Scene& scene, double degrees) {
  for (size_t i = 0; i < scene.lights.size(); ++i) turnLight(scene, i, degrees, 0);
}

void turnObjects(Scene& scene, double degrees) {
  const glm::dquat turn = glm::angleAxis(degrees / kDegrees, glm::dvec3(0, 1, 0));
  const glm::dvec3 centre = subjectSphere(scene).centre;
  for (Object& object : scene.objects) {
    object.position = centre + turn * (object.position - centre);
    object.rotation = glm::normalize(turn * object.rotation);
  }
}

void showClip(Scene& scene, const std::string& clip, double seconds) {
  const auto distance = [&] {
    const CameraFrame camera = cameraFrame(scene, 1, 1);
    const Sphere sphere = boundingSphere(scene, true);
    return glm::distance(camera.position, sphere.radius > 0 ? sphere.centre : boundingSphere(scene).centre);
  };
  const double before = distance();
  setPose(scene.objects[subjectIndex(scene)], clip, seconds);
  if (auto* orbit = std::get_if<OrbitCamera>(&scene.camera)) orbit->factor *= before / distance();
}

void playClips(Scene& scene, double seconds) {
  for (Object& object : scene.objects) {
    if (object.clip.empty() || !object.animation) continue;
    const double length = clipOf(object)->seconds;
    double next = object.time + seconds;
    if (length > 0) next -= length * std::floor(next / length);
    setPose(object, object.clip, next);
  }
}

const MeshAnimation::Clip* clipOf(const Object& object) {
  if (!object.animation) return nullptr;
  const auto& clips = object.animation->clips();
  for (const MeshAnimation::Clip& clip : clips)
    if (clip.name == object.clip) return &clip;
  return &clips.front();
}

Light asPoint(const Scene& scene, const ParallelLight& light) {
  const Sphere sphere = subjectSphere(scene);
  const double distance = 3 * sphere.radius;
  return PointLight{
      .position = sphere.centre + distance * directionFromAngles(light.azimuth, light.elevation),
      .intensity = light.irradiance * distance * distance};
}

Light asParallel(const Scene& scene, const PointLight& light) {
  const Angles angles = anglesOf(light.position - subjectSphere(scene).centre);
  const double distance2 = std::max(angles.length * angles.length, 1e-12);
  return ParallelLight{
      .azimuth = angles.azimuth, .elevation = angles.elevation, .irradiance = light.intensity / distance2};
}

void setSubjectSize(Scene& scene, double size) {
  if (scene.objects.empty()) return;
  Object& subject = scene.objects[subjectIndex(scene)];
  const double wanted = std::clamp(size, 0.1, 10000.0);
  const size_t index = subjectIndex(scene);
  scene = scaledScene(scene, wanted / subject.size);
  scene.objects[index].size = wanted;
}

}  // namespace lychnite
