#include "reference/walk_emission.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "reference/walk_guide.h"

namespace lychnite {

namespace {

double mean(const Rgb& c) {
  return (c.x + c.y + c.z) / 3;
}

struct Triangle {
  std::array<glm::dvec3, 3> corner;
  glm::dvec3 normal;  ///< unit
  double area;

  Triangle(const RayMesh& mesh, uint32_t triangle) {
    const glm::uvec3& t = (*mesh.triangles)[triangle];
    for (int c = 0; c < 3; ++c) corner[size_t(c)] = mesh.positions[t[c]];
    const glm::dvec3 n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    area = 0.5 * glm::length(n);
    normal = area > 0 ? n / (2 * area) : n;
  }
};

/// Irradiance (mean of RGB) at a point of a surface; 0 where it faces away.
double irradiance(const RayLight& light, const glm::dvec3& point, const glm::dvec3& normal) {
  const RayLight::Seen seen = light.seenFrom(point);
  return mean(seen.irradiance) * std::max(0.0, glm::dot(seen.direction, normal));
}

/// Power that arrives at a triangle. One look is exact for parallel light; a near point light gets the mean
/// over the triangle's middle and its corners, never 0 where the triangle faces it at all.
double arrivingPower(const RayLight& light, const Triangle& t) {
  const glm::dvec3 centroid = (t.corner[0] + t.corner[1] + t.corner[2]) / 3.0;
  double e = irradiance(light, centroid, t.normal);
  if (!light.parallel) {
    e *= 0.5;
    for (const glm::dvec3& corner : t.corner) e += irradiance(light, corner, t.normal) / 6;
  }
  return e * t.area;
}

}  // namespace

WalkEmission::WalkEmission(const RayScene& rays) : rays_(rays) {
  for (uint32_t light = 0; light < rays.lights().size(); ++light) addLight(rays, light);
  for (const Patch& patch : patches_) total_ += patch.share;
  buildTable();
}

void WalkEmission::addLight(const RayScene& rays, uint32_t light) {
  for (uint32_t object = 0; object < rays.objectCount(); ++object) {
    if (rays.opaque(int(object))) continue;
    const RayMesh& mesh = rays.mesh(int(object));
    for (uint32_t triangle = 0; triangle < mesh.triangles->size(); ++triangle) {
      const double power = arrivingPower(rays.lights()[light], Triangle(mesh, triangle));
      if (power > 0) patches_.push_back({light, object, triangle, float(power)});
    }
  }
}

void WalkEmission::guide(const std::vector<float>& importance) {
  for (Patch& patch : patches_) {
    const Triangle t(rays_.mesh(int(patch.object)), patch.triangle);
    patch.share *=
        importance[WalkGuideSamples::cellOf(glm::vec3((t.corner[0] + t.corner[1] + t.corner[2]) / 3.0))];
  }
  buildTable();
}

void WalkEmission::buildTable() {
  double all = 0, sum = 0;
  for (const Patch& patch : patches_) all += patch.share;
  before_.clear();
  before_.reserve(patches_.size());
  for (Patch& patch : patches_) {
    before_.push_back(sum / all);
    sum += patch.share;
    patch.share = float(patch.share / all);
  }
  guide_.resize(patches_.size());
  uint32_t at = 0;
  for (size_t i = 0; i < guide_.size(); ++i) {
    while (at + 1 < patches_.size() && before_[at + 1] <= double(i) / double(guide_.size())) ++at;
    guide_[i] = at;
  }
}

WalkEmission::Start WalkEmission::start(double u, transport::Rng& rng) const {
  size_t i = guide_[std::min(size_t(u * double(guide_.size())), guide_.size() - 1)];
  while (i + 1 < patches_.size() && before_[i + 1] <= u) ++i;
  const Patch& patch = patches_[i];
  const float root = std::sqrt(rng.uniform()), v = rng.uniform();
  Start start;
  start.hit = rays_.hitOf(int(patch.object), patch.triangle, root * (1 - v), root * v, 0);
  const RayLight::Seen seen = rays_.lights()[patch.light].seenFrom(start.hit.position);
  start.toLight = glm::vec3(seen.direction);
  start.lightDistance = float(seen.distance);
  const Triangle t(rays_.mesh(int(patch.object)), patch.triangle);
  const double cosine = std::max(0.0, glm::dot(seen.direction, t.normal));
  start.flux = glm::vec3(seen.irradiance * (cosine * t.area / double(patch.share)));
  return start;
}

}  // namespace lychnite
