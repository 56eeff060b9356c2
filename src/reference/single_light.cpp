#include "reference/single_light.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "lychnite/optics/phase.h"

namespace lychnite {

namespace {

using transport::Medium;

constexpr int kMostShells = 16;

/// Where light along `direction` leaves `object`, nested shells of the same object passed through.
RayHit exitOf(const RayScene& rays, int object, const glm::vec3& from, const glm::vec3& direction) {
  glm::vec3 at = from;
  int shells = 1;
  float before = 0;
  for (int i = 0; i < kMostShells; ++i) {
    RayHit hit = rays.nearestInside(object, at, direction);
    if (!hit || hit.object != object) return {};
    before += hit.distance;
    shells += glm::dot(hit.normal, direction) > 0 ? -1 : 1;
    if (shells == 0) {
      hit.distance = before;
      return hit;
    }
    at = offPoint(hit, direction);
  }
  return {};
}

glm::vec3 exp3(const glm::vec3& v) {
  return {std::exp(v.x), std::exp(v.y), std::exp(v.z)};
}

}  // namespace

SingleLight::SingleLight(const RayScene& rays, const CameraReceivers& receivers)
    : rays_(rays), receivers_(receivers) {
  for (int i = 0; i < int(rays.objectCount()); ++i) media_.emplace_back(rays.medium(i));
  eyeRays_.resize(receivers.receivers.size());
  tbb::parallel_for(size_t(0), eyeRays_.size(),
                    [&](size_t i) { eyeRays_[i] = eyeRay(receivers.receivers[i]); });
}

SingleLight::EyeRay SingleLight::eyeRay(const Receiver& receiver) const {
  EyeRay ray;
  const int object = receiver.hit.object;
  const Medium& medium = media_[size_t(object)];
  const float cosO = glm::dot(receiver.normal, receiver.view);
  if (rays_.opaque(object) || cosO <= 0 || medium.sigma_s == glm::vec3(0)) return ray;
  const transport::Boundary boundary = transport::fresnel(std::fmin(cosO, 1.0f), medium.eta);
  ray.direction = transport::refracted(-receiver.view, receiver.normal, medium.eta, cosO, boundary.cosT);
  if (glm::dot(ray.direction, receiver.hit.normal) >= 0) return ray;
  ray.from = offPoint(receiver.hit, ray.direction);
  const RayHit far = exitOf(rays_, object, ray.from, ray.direction);
  ray.length = far ? far.distance : 0;
  ray.leaving = (1 - boundary.reflectance) / (medium.eta * medium.eta);
  return ray;
}

/// Irradiance of the refracted beam at a point, its attenuation from the surface to there, times the phase
/// function towards `outgoing` (1/sr).
glm::vec3 SingleLight::arriving(int object, const glm::vec3& point, const glm::vec3& outgoing,
                                const RayLight& light) const {
  const RayLight::Seen seen = light.seenFrom(point);
  const glm::vec3 towards(seen.direction);
  const RayHit exit = exitOf(rays_, object, point, towards);
  if (!exit || exit.distance >= float(seen.distance)) return glm::vec3(0);
  const RayLight::Seen outside = light.seenFrom(exit.position);
  const glm::vec3 outward(outside.direction);
  if (rays_.occluded(offPoint(exit, outward), outward, float(outside.distance))) return glm::vec3(0);
  const Medium& medium = media_[size_t(object)];
  const float cosI = std::fmin(glm::dot(towards, exit.normal), 1.0f);
  const transport::Boundary boundary = transport::fresnel(cosI, medium.eta);
  const glm::vec3 travel = transport::refracted(-towards, exit.normal, medium.eta, cosI, boundary.cosT);
  const float beam = (1 - boundary.reflectance) * cosI / boundary.cosT;
  const float length = exit.distance * cosI / boundary.cosT;
  const auto phase = float(henyeyGreenstein(double(glm::dot(travel, outgoing)), double(medium.g)));
  return glm::vec3(seen.irradiance) * exp3(-medium.sigma_t * length) * (beam * phase);
}

glm::vec3 SingleLight::sample(const Receiver& receiver, const EyeRay& ray, float u, int channel,
                              int light) const {
  const Medium& medium = media_[size_t(receiver.hit.object)];
  // The depth is drawn for one channel, within the ray; the density is the mean of the three channels', so
  // every channel is unbiased whichever one draws.
  const float drawn = medium.sigma_t[channel];
  const float depth = drawn > 0 ? -std::log1p(-u * -std::expm1(-drawn * ray.length)) / drawn : u * ray.length;
  float density = 0;
  for (int c = 0; c < 3; ++c) {
    const float sigma = medium.sigma_t[c];
    density +=
        sigma > 0 ? sigma * std::exp(-sigma * depth) / -std::expm1(-sigma * ray.length) : 1 / ray.length;
  }
  const glm::vec3 point = ray.from + depth * ray.direction;
  glm::vec3 sum(0);
  for (int l = 0; l < int(rays_.lights().size()); ++l)
    if (light < 0 || l == light)
      sum += arriving(receiver.hit.object, point, -ray.direction, rays_.lights()[size_t(l)]);
  return sum * medium.sigma_s * exp3(-medium.sigma_t * depth) * (3 * ray.leaving / density);
}

void SingleLight::pass(uint64_t number, uint64_t seed, int light, std::vector<glm::vec3>& radiance) const {
  // Receivers of one pixel follow each other, so that a pixel belongs to one task when tasks start at pixel
  // borders.
  const auto& all = receivers_.receivers;
  const size_t tasks = 64;
  const auto border = [&](size_t task) {
    size_t i = all.size() * task / tasks;
    while (i > 0 && i < all.size() && all[i].pixel == all[i - 1].pixel) ++i;
    return i;
  };
  tbb::parallel_for(size_t(0), tasks, [&](size_t task) {
    for (size_t i = border(task), end = border(task + 1); i < end; ++i) {
      if (!(eyeRays_[i].length > 0)) continue;
      // Golden-ratio steps from a random start: any run of passes fills the ray evenly.
      transport::Rng rng(seed ^ 0x51E61E5ull, i);
      const double step = double(rng.uniform()) + double(number) * 0.6180339887498949;
      const auto u = float(step - std::floor(step));
      radiance[all[i].pixel] +=
          all[i].weight * sample(all[i], eyeRays_[i], std::fmin(u, 0.9999999f), int((number + i) % 3), light);
    }
  });
}

std::vector<glm::vec3> singlePart(const RayScene& rays, const CameraReceivers& receivers, uint64_t passes,
                                  uint64_t seed, const Progress& progress) {
  const SingleLight single(rays, receivers);
  std::vector<glm::vec3> sum(receivers.covered.size(), glm::vec3(0));
  for (uint64_t pass = 0; pass < passes; ++pass) {
    progress.check({"single scattering", double(pass) / double(passes), ""});
    single.pass(pass, seed, -1, sum);
  }
  for (glm::vec3& s : sum) s /= float(passes);
  return sum;
}

}  // namespace lychnite
