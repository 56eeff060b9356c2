#include "reference/walk_fan.h"

#include <embree3/rtcore.h>

#include <glm/geometric.hpp>

#include <glm/geometric.hpp>

namespace lychnite {

namespace {

constexpr int kLanes = RayFan::kMost;

struct Lanes {
  alignas(32) int valid[kLanes];
  explicit Lanes(int count) {
    for (int i = 0; i < kLanes; ++i) valid[i] = i < count ? -1 : 0;
  }
};

void setLane(RTCRay8& ray, int i, const glm::vec3& from, const glm::vec3& direction, float distance) {
  ray.org_x[i] = from.x;
  ray.org_y[i] = from.y;
  ray.org_z[i] = from.z;
  ray.dir_x[i] = direction.x;
  ray.dir_y[i] = direction.y;
  ray.dir_z[i] = direction.z;
  ray.tnear[i] = 0;
  ray.tfar[i] = distance;
  ray.time[i] = 0;
  ray.mask[i] = ~0u;
  ray.id[i] = 0;
  ray.flags[i] = 0;
}

}  // namespace

void traceInside(const RayScene& rays, int object, RayFan& fan) {
  const Lanes lanes(fan.count);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit8 packet;
  for (int i = 0; i < fan.count; ++i) {
    setLane(packet.ray, i, fan.from[size_t(i)], fan.direction[size_t(i)],
            std::numeric_limits<float>::infinity());
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect8(lanes.valid, static_cast<RTCScene>(rays.embreeSceneInside(object)), &context, &packet);
  for (int i = 0; i < fan.count; ++i) {
    const bool met = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    RayHit& hit = fan.hit[size_t(i)];
    hit.object = met ? int(packet.hit.geomID[i]) : -1;
    if (!met) continue;
    // From the ray, not from the mesh: that would be three cache misses for each, and half of them are not
    // needed.
    hit.triangle = packet.hit.primID[i];
    hit.distance = packet.ray.tfar[i];
    hit.position = fan.from[size_t(i)] + hit.distance * fan.direction[size_t(i)];
    hit.normal = glm::normalize(glm::vec3(packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]));
    hit.u = packet.hit.u[i];
    hit.v = packet.hit.v[i];
  }
}

void traceSight(const RayScene& rays, SightFan& fan) {
  if (fan.count == 0) return;
  const Lanes lanes(fan.count);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay8 packet;
  for (int i = 0; i < fan.count; ++i)
    setLane(packet, i, fan.from[size_t(i)], fan.direction[size_t(i)], fan.distance[size_t(i)]);
  rtcOccluded8(lanes.valid, static_cast<RTCScene>(rays.embreeScene()), &context, &packet);
  for (int i = 0; i < fan.count; ++i) fan.blocked[size_t(i)] = packet.tfar[i] < 0;
}

}  // namespace lychnite
