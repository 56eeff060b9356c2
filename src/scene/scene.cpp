#include "lychnite/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace lychnite {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

/// The sphere about the middle of the parts' box that holds them all.
Sphere enclosing(const std::vector<Sphere>& parts) {
  if (parts.empty()) return {};
  if (parts.size() == 1) return parts.front();
  glm::dvec3 low(1e300), high(-1e300);
  for (const Sphere& part : parts) {
    low = glm::min(low, part.centre - part.radius);
    high = glm::max(high, part.centre + part.radius);
  }
  Sphere result{0.5 * (low + high), 0};
  for (const Sphere& part : parts)
    result.radius = std::max(result.radius, glm::distance(result.centre, part.centre) + part.radius);
  return result;
}

CameraFrame lookAt(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& up) {
  CameraFrame frame;
  frame.position = position;
  frame.forward = glm::normalize(target - position);
  glm::dvec3 side = glm::cross(frame.forward, up);
  // Looking along `up`, any other axis will do; +z keeps the picture upright when the camera comes over the
  // top.
  if (glm::length(side) < 1e-9 * glm::length(up))
    side = glm::cross(frame.forward, glm::dvec3(0, 0, frame.forward.y > 0 ? 1 : -1));
  frame.right = glm::normalize(side);
  frame.up = glm::cross(frame.right, frame.forward);
  return frame;
}

}  // namespace

glm::dvec3 directionFromAngles(double azimuth, double elevation) {
  const double az = azimuth * kRadians, el = elevation * kRadians;
  return {std::cos(el) * std::sin(az), std::sin(el), std::cos(el) * std::cos(az)};
}

Placement placementOf(const Object& object) {
  const Bounds bounds = extentOf(*object.mesh).bounds;
  return {.centre = bounds.centre(),
          .scale = object.size / bounds.longestSide(),
          .rotation = object.rotation,
          .position = object.position};
}

Sphere boundingSphere(const Object& object) {
  return {object.position, extentOf(*object.mesh).radius * placementOf(object).scale};
}

Sphere boundingSphere(const Scene& scene, bool translucentOnly) {
  std::vector<Sphere> parts;
  for (const Object& object : scene.objects)
    if (!translucentOnly || !object.material.opaque) parts.push_back(boundingSphere(object));
  return enclosing(parts);
}

glm::dvec3 CameraFrame::direction(double x, double y) const {
  const double u = (2 * x / width - 1) * tanHalfFovX;
  const double v = (1 - 2 * y / height) * tanHalfFovY;
  return glm::normalize(forward + right * u + up * v);
}

glm::dvec3 CameraFrame::project(const glm::dvec3& point) const {
  const glm::dvec3 d = point - position;
  const double depth = glm::dot(d, forward);
  return {(glm::dot(d, right) / (depth * tanHalfFovX) + 1) * 0.5 * width,
          (1 - glm::dot(d, up) / (depth * tanHalfFovY)) * 0.5 * height, depth};
}

CameraFrame cameraFrame(const Scene& scene, int width, int height) {
  CameraFrame frame;
  double fov = 30;
  const double aspect = double(width) / height;
  if (const auto* orbit = std::get_if<OrbitCamera>(&scene.camera)) {
    Sphere subject = boundingSphere(scene, true);
    if (subject.radius == 0) subject = boundingSphere(scene);
    fov = orbit->fov;
    // The narrower of the two angles must hold the sphere.
    const double half = fov * 0.5 * kRadians;
    const double narrow = aspect < 1 ? std::atan(std::tan(half) * aspect) : half;
    const double distance = orbit->factor * subject.radius / std::sin(narrow);
    const glm::dvec3 towards = directionFromAngles(orbit->azimuth, orbit->elevation);
    frame = lookAt(subject.centre + distance * towards, subject.centre, {0, 1, 0});
  } else {
    const auto& pinhole = std::get<PinholeCamera>(scene.camera);
    fov = pinhole.fov;
    frame = lookAt(pinhole.position, pinhole.target, pinhole.up);
  }
  frame.tanHalfFovY = std::tan(fov * 0.5 * kRadians);
  frame.tanHalfFovX = frame.tanHalfFovY * aspect;
  frame.width = width;
  frame.height = height;
  return frame;
}

}  // namespace lychnite
