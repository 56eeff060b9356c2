#include "reference/surface_samples.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "lychnite/optics/fresnel.h"
#include "reference/octree.h"

namespace lychnite {
namespace {

uint64_t mix(uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

std::vector<uint64_t> hilbertIndices(const RayMesh& mesh) {
  Box box;
  for (const glm::vec3& p : mesh.positions) box.add(p);
  const glm::vec3 extent = box.high - box.low;
  const float side = std::max({extent.x, extent.y, extent.z});
  std::vector<uint64_t> keys(mesh.triangles->size());
  tbb::parallel_for(size_t(0), keys.size(), [&](size_t i) {
    const glm::uvec3 t = (*mesh.triangles)[i];
    const glm::vec3 centroid = (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f;
    keys[i] = hilbertIndex((centroid - box.low) / side);
  });
  return keys;
}

/// Barycentric coordinates of the point at `u` in [0, 1) of the Sierpinski curve that enters at corner 0,
/// leaves at corner 2 and halves the triangle at the middle of edge 0-2, again and again. Keeps area for any
/// triangle.
glm::dvec3 sierpinskiPoint(double u) {
  glm::dvec3 a(1, 0, 0), b(0, 1, 0), c(0, 0, 1);
  for (int level = 0; level < 26; ++level) {
    const glm::dvec3 middle = 0.5 * (a + c);
    u *= 2;
    if (u < 1) {
      c = b;
    } else {
      u -= 1;
      a = b;
    }
    b = middle;
  }
  return (a + b + c) / 3.0;
}

/// How far along that curve a point with these weights is, in [0, 1].
double sierpinskiLength(glm::dvec3 w) {
  double u = 0, half = 0.5;
  for (int level = 0; level < 26; ++level, half *= 0.5) {
    // The line from corner 1 to the middle of 0-2 parts the halves.
    if (w.x >= w.z) {
      w = {w.x - w.z, 2 * w.z, w.y};
    } else {
      u += half;
      w = {w.y, 2 * w.x, w.z - w.x};
    }
  }
  return u;
}

/// Which corner comes first when a triangle's corners are turned so that edge 0-2 is the longest: halves of a
/// long triangle grow rounder.
int firstCorner(const RayMesh& mesh, const glm::uvec3& t) {
  const auto edge = [&](uint32_t i, uint32_t j) {
    return glm::distance(mesh.positions[i], mesh.positions[j]);
  };
  const float xy = edge(t.x, t.y), yz = edge(t.y, t.z), zx = edge(t.z, t.x);
  if (zx >= xy && zx >= yz) return 0;
  return xy >= yz ? 1 : 2;
}

}  // namespace

double uniformAt(uint64_t seed, uint64_t index) {
  return double(mix(mix(seed * 0x9e3779b97f4a7c15ull) + (index + 1) * 0x9e3779b97f4a7c15ull) >> 11) * 0x1p-53;
}

SurfaceSampler::SurfaceSampler(const RayMesh& mesh) : mesh_(mesh), order_(mesh.triangles->size()) {
  const std::vector<uint64_t> keys = hilbertIndices(mesh);
  std::iota(order_.begin(), order_.end(), 0u);
  tbb::parallel_sort(order_.begin(), order_.end(),
                     [&](uint32_t a, uint32_t b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  place_.resize(order_.size());
  for (size_t i = 0; i < order_.size(); ++i) place_[order_[i]] = uint32_t(i);
  cumulative_.resize(order_.size());
  double sum = 0;
  for (size_t i = 0; i < order_.size(); ++i) {
    const glm::uvec3 t = (*mesh.triangles)[order_[i]];
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    sum += 0.5 * glm::length(glm::cross(b - a, c - a));
    cumulative_[i] = sum;
  }
}

double SurfaceSampler::spacing(size_t n) const {
  return std::sqrt(area() / double(n));
}

MeshPoint SurfaceSampler::at(double areaBefore) const {
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), areaBefore);
  const size_t i = std::min(cumulative_.size() - 1, size_t(found - cumulative_.begin()));
  const double start = i ? cumulative_[i - 1] : 0;
  const int first = firstCorner(mesh_, (*mesh_.triangles)[order_[i]]);
  const double u = (areaBefore - start) / std::max(cumulative_[i] - start, 1e-300);
  const glm::dvec3 turned = sierpinskiPoint(std::clamp(u, 0.0, 1 - 1e-12));
  glm::dvec3 w;
  for (int c = 0; c < 3; ++c) w[(first + c) % 3] = turned[c];
  return {order_[i], float(w.y), float(w.z)};
}

size_t SurfaceSampler::patchOf(const MeshPoint& point, size_t n) const {
  const uint32_t i = place_[point.triangle];
  const double start = i ? cumulative_[i - 1] : 0;
  const int first = firstCorner(mesh_, (*mesh_.triangles)[point.triangle]);
  const glm::dvec3 w(1 - double(point.u) - double(point.v), point.u, point.v);
  const glm::dvec3 turned(w[first], w[(first + 1) % 3], w[(first + 2) % 3]);
  const double area = start + sierpinskiLength(turned) * (cumulative_[i] - start);
  return std::min(n - 1, size_t(area / cumulative_.back() * double(n)));
}

std::vector<MeshPoint> SurfaceSampler::pointsOfPatches(size_t n, size_t each, uint64_t seed) const {
  std::vector<MeshPoint> points(n * each);
  const double part = area() / double(points.size());
  tbb::parallel_for(size_t(0), points.size(),
                    [&](size_t i) { points[i] = at((double(i) + uniformAt(seed, i)) * part); });
  return points;
}

std::vector<SurfacePoint> SurfaceSampler::sample(size_t n, uint64_t seed) const {
  std::vector<SurfacePoint> points(n);
  const double patch = area() / double(n);
  tbb::parallel_for(size_t(0), n, [&](size_t i) {
    const MeshPoint p = at((double(i) + uniformAt(seed, i)) * patch);
    const glm::uvec3& t = (*mesh_.triangles)[p.triangle];
    points[i] = {.position = mesh_.positions[t.x] * (1 - p.u - p.v) + mesh_.positions[t.y] * p.u +
                             mesh_.positions[t.z] * p.v,
                 .normal = mesh_.facets[p.triangle]};
  });
  return points;
}

Rgb enteringIrradiance(const RayScene& scene, double eta, const SurfacePoint& point, int light) {
  Rgb sum(0);
  for (size_t i = 0; i < scene.lights().size(); ++i) {
    if (light >= 0 && size_t(light) != i) continue;
    const RayLight::Seen seen = scene.lights()[i].seenFrom(point.position);
    const double cosI = glm::dot(seen.direction, glm::dvec3(point.normal));
    if (cosI <= 0) continue;
    RayHit hit;
    hit.position = point.position;
    hit.normal = point.normal;
    const glm::vec3 direction(seen.direction);
    if (scene.occluded(offPoint(hit, direction), direction, float(seen.distance))) continue;
    sum += fresnelTransmittance(cosI, eta) * cosI * seen.irradiance;
  }
  return sum;
}

FluxPoints litSamples(const RayScene& scene, int object, const SurfaceSampler& sampler, size_t n,
                      uint64_t seed, int light) {
  const std::vector<SurfacePoint> points = sampler.sample(n, seed);
  std::vector<glm::vec3> flux(n);
  const double area = sampler.area() / double(n), eta = scene.medium(object).eta;
  tbb::parallel_for(size_t(0), n, [&](size_t i) {
    flux[i] = glm::vec3(enteringIrradiance(scene, eta, points[i], light) * area);
  });
  FluxPoints lit;
  lit.reserve(n);
  for (size_t i = 0; i < n; ++i)
    if (flux[i] != glm::vec3(0)) lit.add(points[i].position, flux[i]);
  return lit;
}

}  // namespace lychnite
