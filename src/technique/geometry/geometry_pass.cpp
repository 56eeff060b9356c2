#include "technique/geometry/geometry_pass.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lychnite {
namespace {

Key keyOf(const Frame& frame) {
  Key key;
  key.add(frame.camera.width).add(frame.camera.height).add(frame.toClip).add(frame.camera.position);
  for (const FrameObject& object : frame.objects) key.add(double(object.mesh)).add(object.toWorld);
  return key;
}

}  // namespace

GeometryPass::GeometryPass()
    : program_({.label = "geometry",
                .vertex = "pass/geometry.vert",
                .fragment = "pass/geometry.frag",
                .defines = {},
                .root = {}}) {}

void GeometryPass::resize(int width, int height) {
  if (targets_ && targets_->samples.width() == width && targets_->samples.height() == height) return;
  targets_.reset();
  gpu::Texture samples(
      {.label = "geometry samples", .format = gpu::Format::kRgba32f, .width = width, .height = height});
  gpu::Texture depth(
      {.label = "geometry depth", .format = gpu::Format::kDepth32f, .width = width, .height = height});
  gpu::Framebuffer framebuffer({.label = "geometry", .colours = {samples}, .depth = depth});
  targets_.emplace(Targets{std::move(samples), std::move(depth), std::move(framebuffer)});
}

bool GeometryPass::update(const Frame& frame, const MeshCache& meshes) {
  const Key key = keyOf(frame);
  if (targets_ && key == key_) return false;
  key_ = Key();
  resize(2 * frame.camera.width, 2 * frame.camera.height);
  targets_->framebuffer.clearColour(0, {0, 0, 0, 0});
  targets_->framebuffer.clearDepth();
  gpu::Pass pass("geometry", targets_->framebuffer, {.depthTest = gpu::DepthTest::kLess, .depthWrite = true});
  program_.set("cameraPosition", glm::vec3(frame.camera.position));
  for (size_t i = 0; i < frame.objects.size(); ++i) {
    const FrameObject& object = frame.objects[i];
    program_.set("toWorld", glm::mat4(object.toWorld));
    program_.set("toClip", glm::mat4(frame.toClip * object.toWorld));
    program_.set("normalToWorld", object.normalToWorld);
    program_.set("objectNumber", float(i + 1));
    pass.drawMesh(program_, meshes.get(object));
  }
  key_ = key;
  return true;
}

void setReceiverUniforms(gpu::Program& program, const Frame& frame, const gpu::Texture& samples,
                         size_t object) {
  const CameraFrame& camera = frame.camera;
  program.setTexture("geometry", samples);
  program.set("cameraPosition", glm::vec3(camera.position));
  program.set("cameraRight", glm::vec3(camera.right * camera.tanHalfFovX));
  program.set("cameraUp", glm::vec3(camera.up * camera.tanHalfFovY));
  program.set("cameraForward", glm::vec3(camera.forward));
  program.set("objectNumber", float(object + 1));
}

gpu::Rect screenBounds(const Frame& frame, const FrameObject& object) {
  const CameraFrame& camera = frame.camera;
  const gpu::Rect whole{0, 0, camera.width, camera.height};
  const glm::dvec3 d = object.bounds.centre - camera.position;
  const double depth = glm::dot(d, camera.forward), radius = object.bounds.radius;
  if (depth + radius <= 0) return {};
  if (depth - radius <= 0) return whole;
  // In the plane of the axis and one picture direction the sphere is a circle; its tangents bound the
  // picture.
  const auto interval = [&](double across, double tangent, int size) {
    const double distance2 = across * across + depth * depth;
    if (distance2 <= radius * radius) return std::pair(0, size);
    const double half = std::asin(std::min(1.0, radius / std::sqrt(distance2))),
                 middle = std::atan2(across, depth);
    const auto pixel = [&](double angle) {
      const double slope = std::tan(std::clamp(angle, -1.57, 1.57));
      return (slope / tangent + 1) * 0.5 * size;
    };
    const int low = int(std::clamp(std::floor(pixel(middle - half)) - 1, 0.0, double(size)));
    const int high = int(std::clamp(std::ceil(pixel(middle + half)) + 1, 0.0, double(size)));
    return std::pair(low, high);
  };
  const auto [x0, x1] = interval(glm::dot(d, camera.right), camera.tanHalfFovX, camera.width);
  const auto [y0, y1] = interval(glm::dot(d, camera.up), camera.tanHalfFovY, camera.height);
  return {x0, y0, x1 - x0, y1 - y0};
}

}  // namespace lychnite
