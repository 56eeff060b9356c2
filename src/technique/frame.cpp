#include "technique/frame.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace lychnite {
namespace {

double unitOf(const Scene& scene) {
  double translucent = 0, any = 0;
  for (const Object& object : scene.objects) {
    any = std::max(any, object.size);
    if (!object.material.opaque) translucent = std::max(translucent, object.size);
  }
  return translucent > 0 ? translucent : any;
}

FrameObject makeObject(const Object& object, double unit, const glm::dvec3& origin) {
  FrameObject result;
  result.source = &object;
  const Placement placement = placementOf(object);
  const glm::dmat4 rotation = glm::mat4_cast(placement.rotation);
  result.toWorld = glm::translate(glm::dmat4(1), (placement.position - origin) / unit) * rotation *
                   glm::scale(glm::dmat4(1), glm::dvec3(placement.scale / unit)) *
                   glm::translate(glm::dmat4(1), -placement.centre);
  result.normalToWorld = glm::mat3(rotation);
  const Sphere sphere = boundingSphere(object);
  result.bounds = {(sphere.centre - origin) / unit, sphere.radius / unit};
  result.medium = object.material.medium.scaled(1 / unit);
  result.translucent = !object.material.opaque;
  return result;
}

/// Near and far planes just around the objects; the near one never nearer than a ten-thousandth of the far
/// one, for the depth buffer's sake.
glm::dmat4 clipFromWorld(const CameraFrame& camera, const std::vector<FrameObject>& objects) {
  double nearest = 1e300, farthest = 0;
  for (const FrameObject& object : objects) {
    const double along = glm::dot(object.bounds.centre - camera.position, camera.forward);
    nearest = std::min(nearest, along - object.bounds.radius);
    farthest = std::max(farthest, along + object.bounds.radius);
  }
  farthest = std::max(farthest * 1.001, 1e-6);
  nearest = std::max(nearest * 0.999, farthest * 1e-4);
  const double x = 1 / camera.tanHalfFovX, y = 1 / camera.tanHalfFovY;
  const double a = (farthest + nearest) / (farthest - nearest),
               b = -2 * farthest * nearest / (farthest - nearest);
  const glm::dvec3 &r = camera.right, &u = camera.up, &f = camera.forward;
  const glm::dmat4 view(glm::dvec4(r.x, u.x, f.x, 0), glm::dvec4(r.y, u.y, f.y, 0),
                        glm::dvec4(r.z, u.z, f.z, 0),
                        glm::dvec4(-glm::dot(r, camera.position), -glm::dot(u, camera.position),
                                   -glm::dot(f, camera.position), 1));
  const glm::dmat4 projection(glm::dvec4(x, 0, 0, 0), glm::dvec4(0, y, 0, 0), glm::dvec4(0, 0, a, 1),
                              glm::dvec4(0, 0, b, 0));
  return projection * view;
}

Light inUnits(const Light& light, double unit, const glm::dvec3& origin) {
  Light result = light;
  if (auto* point = std::get_if<PointLight>(&result)) {
    point->position = (point->position - origin) / unit;
    point->intensity /= unit * unit;
  }
  return result;
}

}  // namespace

Frame makeFrame(const Scene& scene, int width, int height) {
  Frame frame;
  frame.unit = unitOf(scene);
  const Sphere subject = boundingSphere(scene, true);
  frame.origin = subject.radius > 0 ? subject.centre : boundingSphere(scene).centre;
  for (const Object& object : scene.objects)
    frame.objects.push_back(makeObject(object, frame.unit, frame.origin));
  for (const Light& light : scene.lights) frame.lights.push_back(inUnits(light, frame.unit, frame.origin));
  frame.camera = cameraFrame(scene, width, height);
  frame.camera.position = (frame.camera.position - frame.origin) / frame.unit;
  frame.toClip = clipFromWorld(frame.camera, frame.objects);
  return frame;
}

}  // namespace lychnite
