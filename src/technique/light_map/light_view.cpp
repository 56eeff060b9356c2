#include "technique/light_map/light_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

/// Right and up across `forward`; continuous except where the light passes through +y or -y.
void completeAxes(LightView& view) {
  const glm::dvec3 hint = std::abs(view.forward.y) < 0.999 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
  view.right = glm::normalize(glm::cross(view.forward, hint));
  view.up = glm::cross(view.right, view.forward);
}

/// A texel of margin all around keeps the object's silhouette off the border at any map size from 128 up.
constexpr double kMargin = 1.02;

void fitParallel(LightView& view, const ParallelLight& light, const Frame& frame, const Sphere& target) {
  view.forward = -directionFromAngles(light.azimuth, light.elevation);
  completeAxes(view);
  view.power = light.irradiance;
  view.halfWidth = target.radius * kMargin;
  // Depth 0 lies before everything that could block the light.
  double first = -target.radius;
  for (const FrameObject& object : frame.objects)
    first =
        std::min(first, glm::dot(object.bounds.centre - target.centre, view.forward) - object.bounds.radius);
  view.origin = target.centre + view.forward * (first - 0.01 * target.radius);
  view.nearDepth = 0;
  const double centreDepth = glm::dot(target.centre - view.origin, view.forward);
  view.farDepth = centreDepth + target.radius * kMargin;
}

/// Mean direction from the light to the vertices: a better axis than the centre's for what is close and wide.
glm::dvec3 meanDirection(const glm::dvec3& from, const FrameObject& object) {
  glm::dvec3 sum(0);
  for (const glm::vec3& p : object.source->mesh->positions) {
    const glm::dvec3 d = glm::dvec3(object.toWorld * glm::dvec4(p, 1)) - from;
    if (const double length = glm::length(d); length > 0) sum += d / length;
  }
  return glm::length(sum) > 1e-9 ? glm::normalize(sum) : glm::dvec3(0, -1, 0);
}

/// Largest tangent between the axis and a vertex; infinite for one beside or behind the light.
double widestTangent(const LightView& view, const FrameObject& object) {
  double widest = 0;
  for (const glm::vec3& p : object.source->mesh->positions) {
    const glm::dvec3 d = glm::dvec3(object.toWorld * glm::dvec4(p, 1)) - view.origin;
    const double along = glm::dot(d, view.forward);
    if (along <= 0) return INFINITY;
    const double across = std::max(std::abs(glm::dot(d, view.right)), std::abs(glm::dot(d, view.up)));
    widest = std::max(widest, across / along);
  }
  return widest;
}

void fitPoint(LightView& view, const PointLight& light, const Frame& frame, size_t target,
              size_t lightIndex) {
  const Sphere& sphere = frame.objects[target].bounds;
  const double distance = glm::distance(sphere.centre, light.position);
  view.perspective = true;
  view.origin = light.position;
  view.power = light.intensity;
  const double sine = distance > 0 ? sphere.radius / distance : INFINITY;
  // Up to 60 degrees around the sphere; nearer, what the object itself takes up.
  const bool near = sine > 0.5;
  view.forward = near ? meanDirection(light.position, frame.objects[target])
                      : (sphere.centre - light.position) / distance;
  completeAxes(view);
  double tangent = near ? widestTangent(view, frame.objects[target]) : sine / std::sqrt(1 - sine * sine);
  constexpr double kWidest = 6;  // 160 degrees; beyond, the texels in the middle are too few
  if (!(tangent < kWidest)) {
    // An opaque object only loses shadows at its far rim; a translucent one would lose light.
    if (frame.objects[target].translucent)
      throw Error(
          {.where = fmt::format("light {}", lightIndex + 1),
           .expected = "a point light that sees the whole object within 160 degrees",
           .found = fmt::format("one {:.3g} object sizes from the centre of object {}", distance, target + 1),
           .todo = "move it away, or render with --method walk"},
          Error::Kind::kUsage);
    tangent = kWidest;
  }
  view.halfWidth = tangent * kMargin;
  view.farDepth = distance + sphere.radius * kMargin;
  view.nearDepth = std::max(distance - sphere.radius, view.farDepth * 1e-3);
  for (const FrameObject& object : frame.objects) {
    const double first = glm::distance(object.bounds.centre, light.position) - object.bounds.radius;
    view.nearDepth = std::min(view.nearDepth, std::max(first * 0.99, view.farDepth * 1e-3));
  }
}

}  // namespace

glm::dvec3 LightView::project(const glm::dvec3& p) const {
  const glm::dvec3 d = p - origin;
  const double depth = glm::dot(d, forward);
  const double scale = 0.5 / (halfWidth * (perspective ? depth : 1));
  return {glm::dot(d, right) * scale + 0.5, glm::dot(d, up) * scale + 0.5, depth};
}

glm::dvec3 LightView::unproject(const glm::dvec2& uv, double depth) const {
  const double scale = 2 * halfWidth * (perspective ? depth : 1);
  return origin + right * ((uv.x - 0.5) * scale) + up * ((uv.y - 0.5) * scale) + forward * depth;
}

glm::dvec3 LightView::travel(const glm::dvec3& p) const {
  return perspective ? glm::normalize(p - origin) : forward;
}

double LightView::windowArea(const glm::dvec3& p, double depth) const {
  const double side = 2 * halfWidth * (perspective ? depth : 1);
  return side * side * glm::dot(travel(p), forward);
}

glm::dmat4 LightView::toClip() const {
  const glm::dvec3 &r = right, &u = up, &f = forward;
  const glm::dmat4 view(glm::dvec4(r.x, u.x, f.x, 0), glm::dvec4(r.y, u.y, f.y, 0),
                        glm::dvec4(r.z, u.z, f.z, 0),
                        glm::dvec4(-glm::dot(r, origin), -glm::dot(u, origin), -glm::dot(f, origin), 1));
  const double scale = 1 / halfWidth;
  const double span = farDepth - nearDepth;
  const double a = (farDepth + nearDepth) / span;
  const glm::dmat4 projection =
      perspective ? glm::dmat4(glm::dvec4(scale, 0, 0, 0), glm::dvec4(0, scale, 0, 0), glm::dvec4(0, 0, a, 1),
                               glm::dvec4(0, 0, -2 * farDepth * nearDepth / span, 0))
                  : glm::dmat4(glm::dvec4(scale, 0, 0, 0), glm::dvec4(0, scale, 0, 0),
                               glm::dvec4(0, 0, 2 / span, 0), glm::dvec4(0, 0, -a, 1));
  return projection * view;
}

void LightView::setUniforms(gpu::Program& program) const {
  program.set("viewOrigin", glm::vec3(origin));
  program.set("viewRight", glm::vec3(right));
  program.set("viewUp", glm::vec3(up));
  program.set("viewForward", glm::vec3(forward));
  program.set("viewHalfWidth", float(halfWidth));
  program.set("viewPerspective", perspective ? 1.0f : 0.0f);
  program.set("lightPower", glm::vec3(power));
}

Key LightView::key() const {
  return Key()
      .add(origin)
      .add(right)
      .add(up)
      .add(forward)
      .add(halfWidth)
      .add(perspective)
      .add(nearDepth)
      .add(farDepth);
}

LightView fitLightView(const Frame& frame, size_t target, size_t light) {
  LightView view;
  if (const auto* parallel = std::get_if<ParallelLight>(&frame.lights[light]))
    fitParallel(view, *parallel, frame, frame.objects[target].bounds);
  else
    fitPoint(view, std::get<PointLight>(frame.lights[light]), frame, target, light);
  view.backgroundDepth = view.farDepth;
  view.centreDepth = glm::dot(frame.objects[target].bounds.centre - view.origin, view.forward);
  return view;
}

}  // namespace lychnite
