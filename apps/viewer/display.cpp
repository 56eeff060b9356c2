#include "display.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace lychnite::viewer {

Display::Display()
    : program_({.label = "display", .vertex = "pass/full_screen.vert", .fragment = "view/display.frag"}) {}

void Display::draw(const gpu::Framebuffer& target, const Frame& frame) {
  const gpu::Rect& area = frame.area;
  if (area.width <= 0 || area.height <= 0) return;
  const bool compares = frame.right && frame.compare.mode != CompareView::Mode::kOff;
  program_.set("area", glm::vec4(area.x, area.y, area.width, area.height));
  program_.setTexture("leftPicture", *frame.left);
  program_.setTexture("rightPicture", frame.right ? *frame.right : *frame.left);
  program_.set("compareMode", compares ? int(frame.compare.mode) : 0);
  program_.set("wipe", frame.compare.wipe);
  program_.set("meanOfRight", std::max(frame.meanOfRight, 1e-12));
  program_.set("fullScale", frame.compare.full);
  program_.set("gain", std::exp2(frame.toneMapping.exposure));
  program_.set("curve", frame.toneMapping.curve == ToneMapping::Curve::kFilmic ? 1 : 0);
  const Layer layer = frame.layer.value_or(Layer{});
  program_.set("layer", layer.kind);
  program_.setTexture("layerTexture", layer.texture ? *layer.texture : *frame.left);
  program_.set("layerLow", layer.low);
  program_.set("layerHigh", layer.high);
  program_.set("layerLevel", layer.level);
  setGrid(frame);
  gpu::Pass pass("display", target, {.viewport = area});
  pass.drawFullScreen(program_);
}

void Display::setGrid(const Frame& frame) {
  program_.set("grid", frame.grid ? 1 : 0);
  if (!frame.grid) return;
  const Scene& scene = *frame.grid;
  const CameraFrame camera = cameraFrame(scene, frame.area.width, frame.area.height);
  const Object& subject = scene.objects[subjectIndex(scene)];
  const double radius = boundingSphere(subject).radius;
  const glm::dvec3 origin(subject.position.x, groundHeight(scene), subject.position.z);
  program_.set("eye", glm::vec3((camera.position - origin) / radius));
  program_.set("right", glm::vec3(camera.right * camera.tanHalfFovX));
  program_.set("up", glm::vec3(camera.up * camera.tanHalfFovY));
  program_.set("forward", glm::vec3(camera.forward));
  program_.set("gridSpacing", gridSpacing(scene) / radius);
  if (camera.position.y <= origin.y) program_.set("grid", 0);  // from below, the ground would hide the object
}

double gridSpacing(const Scene& scene) {
  const double wanted = scene.objects[subjectIndex(scene)].size / 12;
  const double decade = std::pow(10, std::floor(std::log10(wanted)));
  for (const double step : {1.0, 2.0, 5.0})
    if (wanted <= step * decade * 1.0001) return step * decade;
  return 10 * decade;
}

double groundHeight(const Scene& scene) {
  const Object& subject = scene.objects[subjectIndex(scene)];
  const Bounds bounds = extentOf(*subject.mesh).bounds;
  const Placement placement = placementOf(subject);
  double lowest = 1e300;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1 ? bounds.max : bounds.min).x, (corner & 2 ? bounds.max : bounds.min).y,
                       (corner & 4 ? bounds.max : bounds.min).z);
    lowest = std::min(lowest, placement.point(p).y);
  }
  return lowest;
}

}  // namespace lychnite::viewer
