#include "reference/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "lychnite/base/error.h"

namespace lychnite {

namespace {

RayLight lightInUnits(const Light& light, const glm::dvec3& origin, double unit) {
  RayLight result;
  if (const auto* parallel = std::get_if<ParallelLight>(&light)) {
    result.direction = directionFromAngles(parallel->azimuth, parallel->elevation);
    result.power = parallel->irradiance;
  } else {
    const auto& point = std::get<PointLight>(light);
    result.parallel = false;
    result.position = (point.position - origin) / unit;
    result.power = point.intensity / (unit * unit);
  }
  return result;
}

constexpr double kSameShape = 1e-7;  // scene units: what rounding may move

/// Centre and length of the scene's unit, mm.
Sphere sceneUnits(const Scene& scene) {
  const bool anyTranslucent = std::any_of(scene.objects.begin(), scene.objects.end(),
                                          [](const Object& object) { return !object.material.opaque; });
  return boundingSphere(scene, anyTranslucent);
}

RayMesh meshInUnits(const Object& object, const glm::dvec3& origin, double unit) {
  const Placement placement = placementOf(object);
  RayMesh result;
  result.positions.reserve(object.mesh->positions.size() + 1);  // Embree reads 16 bytes at the last vertex
  result.normals.reserve(object.mesh->normals.size());
  for (const glm::vec3& p : object.mesh->positions)
    result.positions.emplace_back((placement.point(glm::dvec3(p)) - origin) / unit);
  for (const glm::vec3& n : object.mesh->normals)
    result.normals.emplace_back(placement.direction(glm::dvec3(n)));
  result.triangles = &object.mesh->triangles;
  for (const glm::uvec3& t : object.mesh->triangles) {
    const glm::dvec3 a = result.positions[t.x], b = result.positions[t.y], c = result.positions[t.z];
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double length = glm::length(n);
    result.facets.push_back(length > 0 ? glm::vec3(n / length) : glm::vec3(0, 1, 0));
  }
  return result;
}

RTCRayHit rayOf(const glm::vec3& from, const glm::vec3& direction, float maxDistance) {
  RTCRayHit ray;
  ray.ray.org_x = from.x;
  ray.ray.org_y = from.y;
  ray.ray.org_z = from.z;
  ray.ray.dir_x = direction.x;
  ray.ray.dir_y = direction.y;
  ray.ray.dir_z = direction.z;
  ray.ray.tnear = 0;
  ray.ray.tfar = maxDistance;
  ray.ray.time = 0;
  ray.ray.mask = ~0u;
  ray.ray.id = 0;
  ray.ray.flags = 0;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

}  // namespace

RayLight::Seen RayLight::seenFrom(const glm::dvec3& point) const {
  if (parallel) return {direction, std::numeric_limits<double>::infinity(), power};
  const glm::dvec3 way = position - point;
  const double distance = glm::length(way);
  return {way / distance, distance, power / (distance * distance)};
}

glm::vec3 RayMesh::shadingNormal(const RayHit& hit) const {
  const glm::uvec3& t = (*triangles)[hit.triangle];
  const glm::vec3 sum = normals[t.x] * (1 - hit.u - hit.v) + normals[t.y] * hit.u + normals[t.z] * hit.v;
  const float length = glm::length(sum);
  return length > 1e-6f ? sum / length : hit.normal;
}

glm::vec3 offPoint(const RayHit& hit, const glm::vec3& direction) {
  return hit.position + std::copysign(RayScene::kOffset, glm::dot(direction, hit.normal)) * hit.normal;
}

struct RayScene::Impl {
  RTCDevice device = nullptr;
  RTCScene all = nullptr;
  std::vector<RTCScene> inside;  ///< per object; the same as `all` where nothing has to be left out

  ~Impl() {
    for (RTCScene scene : inside)
      if (scene && scene != all) rtcReleaseScene(scene);
    if (all) rtcReleaseScene(all);
    if (device) rtcReleaseDevice(device);
  }

  RTCScene newScene() const {
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    return scene;
  }

  RTCGeometry newGeometry(const RayMesh& mesh) const {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(),
                               0, sizeof(glm::vec3), mesh.positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles->data(),
                               0, sizeof(glm::uvec3), mesh.triangles->size());
    rtcCommitGeometry(geometry);
    return geometry;
  }
};

RayScene::RayScene(const Scene& scene) : scene_(scene), impl_(std::make_unique<Impl>()) {
  size_t translucent = 0;
  for (const Object& object : scene_.objects) translucent += object.material.opaque ? 0 : 1;
  const Sphere bounds = sceneUnits(scene_);
  unit_ = bounds.radius;
  origin_ = bounds.centre;
  for (const Object& object : scene_.objects) meshes_.push_back(meshInUnits(object, origin_, unit_));
  for (const Light& light : scene_.lights) lights_.push_back(lightInUnits(light, origin_, unit_));

  impl_->device = rtcNewDevice(nullptr);
  if (!impl_->device)
    throw Error({.where = "Embree", .expected = "a ray tracing device", .found = "none", .todo = {}},
                Error::Kind::kDevice);
  std::vector<RTCGeometry> geometries;
  for (const RayMesh& mesh : meshes_) geometries.push_back(impl_->newGeometry(mesh));
  const auto build = [&](auto&& included) {
    RTCScene result = impl_->newScene();
    for (size_t i = 0; i < geometries.size(); ++i)
      if (included(i)) rtcAttachGeometryByID(result, geometries[i], unsigned(i));
    rtcCommitScene(result);
    return result;
  };
  impl_->all = build([](size_t) { return true; });
  for (size_t i = 0; i < geometries.size(); ++i) {
    const bool own = !opaque(int(i)) && translucent > 1;
    impl_->inside.push_back(own ? build([&](size_t j) { return j == i || opaque(int(j)); }) : impl_->all);
  }
  for (RTCGeometry geometry : geometries) rtcReleaseGeometry(geometry);
  const RTCError error = rtcGetDeviceError(impl_->device);
  if (error != RTC_ERROR_NONE)
    throw Error({.where = "Embree",
                 .expected = "a scene that can be traced",
                 .found = "error " + std::to_string(error),
                 .todo = "use a smaller mesh or free memory"},
                Error::Kind::kDevice);
}

RayScene::~RayScene() = default;

bool RayScene::adopt(const Scene& scene) {
  const Sphere bounds = sceneUnits(scene);
  if (scene.objects.size() != scene_.objects.size() || !(bounds.radius > 0)) return false;
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    const Object &now = scene_.objects[i], &next = scene.objects[i];
    const glm::dvec3 moved = toUnits(now.position) - (next.position - bounds.centre) / bounds.radius;
    if (now.mesh != next.mesh || now.material.opaque != next.material.opaque ||
        now.rotation != next.rotation ||
        std::abs(now.size / unit_ - next.size / bounds.radius) > kSameShape ||
        glm::length(moved) > kSameShape)
      return false;
  }
  scene_ = scene;
  unit_ = bounds.radius;
  origin_ = bounds.centre;
  lights_.clear();
  for (const Light& light : scene_.lights) lights_.push_back(lightInUnits(light, origin_, unit_));
  return true;
}

CameraFrame RayScene::camera(int width, int height) const {
  CameraFrame frame = cameraFrame(scene_, width, height);
  frame.position = toUnits(frame.position);
  return frame;
}

RayHit RayScene::hitOf(int object, uint32_t triangle, float u, float v, float distance) const {
  const RayMesh& m = mesh(object);
  const glm::uvec3& t = (*m.triangles)[triangle];
  RayHit hit;
  hit.object = object;
  hit.triangle = triangle;
  hit.distance = distance;
  hit.u = u;
  hit.v = v;
  hit.position = m.positions[t.x] * (1 - u - v) + m.positions[t.y] * u + m.positions[t.z] * v;
  hit.normal = m.facets[triangle];
  return hit;
}

namespace {

RayHit nearestIn(const RayScene& rays, void* scene, const glm::vec3& from, const glm::vec3& direction,
                 float maxDistance) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit ray = rayOf(from, direction, maxDistance);
  rtcIntersect1(static_cast<RTCScene>(scene), &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return rays.hitOf(int(ray.hit.geomID), ray.hit.primID, ray.hit.u, ray.hit.v, ray.ray.tfar);
}

}  // namespace

RayHit RayScene::nearest(const glm::vec3& from, const glm::vec3& direction, float maxDistance) const {
  return nearestIn(*this, impl_->all, from, direction, maxDistance);
}

RayHit RayScene::nearestInside(int object, const glm::vec3& from, const glm::vec3& direction,
                               float maxDistance) const {
  return nearestIn(*this, embreeSceneInside(object), from, direction, maxDistance);
}

bool RayScene::occluded(const glm::vec3& from, const glm::vec3& direction, float maxDistance) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = rayOf(from, direction, maxDistance).ray;
  rtcOccluded1(impl_->all, &context, &ray);
  return ray.tfar < 0;
}

bool RayScene::inside(int object, const glm::vec3& point) const {
  const glm::vec3 direction = glm::normalize(glm::vec3(0.3127f, 0.8219f, 0.4763f));
  glm::vec3 from = point;
  for (int i = 0; i < 64; ++i) {
    const RayHit hit = nearestInside(object, from, direction);
    if (!hit) return false;
    if (hit.object == object) return glm::dot(hit.normal, direction) > 0;
    from = offPoint(hit, direction);
  }
  return false;
}

void* RayScene::embreeScene() const {
  return impl_->all;
}
void* RayScene::embreeSceneInside(int object) const {
  return impl_->inside[size_t(object)];
}

}  // namespace lychnite
