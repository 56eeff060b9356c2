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

/// Shares of each channel's free flights that have ended after a distance.
glm::vec3 ended(const glm::vec3& sigma_t, float distance) {
  return {-std::expm1(-sigma_t.x * distance), -std::expm1(-sigma_t.y * distance),
          -std::expm1(-sigma_t.z * distance)};
}

struct Depth {
  float value, density;  ///< along a ray, per length
};

/// Free flights of three channels within a length: of each a third.
class Flights {
 public:
  Flights(const glm::vec3& sigma_t, float length)
      : sigma_t_(sigma_t), length_(length), within_(ended(sigma_t, length)) {}

  /// Where the share u of them ends. One draw for all: every channel is unbiased, and even u spread evenly
  /// over each of them.
  Depth draw(float u) const {
    constexpr int kMostSteps = 16;
    constexpr float kClose = 1e-5f;
    float low = length_, high = 0;  // of one channel alone
    for (int c = 0; c < 3; ++c) {
      const float d = clear(c) ? u * length_ : std::fmin(-std::log1p(-u * within_[c]) / sigma_t_[c], length_);
      low = std::fmin(low, d);
      high = std::fmax(high, d);
    }
    float value = low;  // the share is concave in the depth: Newton's steps come from below
    for (int step = 0;; ++step) {
      const glm::vec3 now = ended(sigma_t_, value);
      float share = 0, density = 0;
      for (int c = 0; c < 3; ++c) {
        share += (clear(c) ? value / length_ : now[c] / within_[c]) / 3;
        density += (clear(c) ? 1 / length_ : sigma_t_[c] * (1 - now[c]) / within_[c]) / 3;
      }
      if (step == kMostSteps || std::fabs(u - share) < kClose) return {value, density};
      (share < u ? low : high) = value;
      const float next = value + (u - share) / density;
      value = next > low && next < high ? next : 0.5f * (low + high);
    }
  }

 private:
  bool clear(int c) const { return sigma_t_[c] * length_ < 1e-6f; }

  glm::vec3 sigma_t_;
  float length_;
  glm::vec3 within_;  ///< that end within the length
};

}  // namespace

SingleLight::SingleLight(const RayScene& rays, const CameraReceivers& receivers)
    : rays_(rays), receivers_(receivers) {
  updateMedia();
  eyeRays_.resize(receivers.receivers.size());
  tbb::parallel_for(size_t(0), eyeRays_.size(),
                    [&](size_t i) { eyeRays_[i] = eyeRay(receivers.receivers[i]); });
}

void SingleLight::updateMedia() {
  media_.clear();
  for (int i = 0; i < int(rays_.objectCount()); ++i) media_.emplace_back(rays_.medium(i));
}

SingleLight::EyeRay SingleLight::eyeRay(const Receiver& receiver) const {
  EyeRay ray;
  const int object = receiver.hit.object;
  const Medium& medium = media_[size_t(object)];
  const float cosO = glm::dot(receiver.normal, receiver.view);
  if (rays_.opaque(object) || cosO <= 0) return ray;
  const transport::Boundary boundary = transport::fresnel(std::fmin(cosO, 1.0f), medium.eta);
  ray.direction = transport::refracted(-receiver.view, receiver.normal, medium.eta, cosO, boundary.cosT);
  if (glm::dot(ray.direction, receiver.hit.normal) >= 0) return ray;
  ray.from = offPoint(receiver.hit, ray.direction);
  ray.leaving = (1 - boundary.reflectance) / (medium.eta * medium.eta);
  const RayHit far = exitOf(rays_, object, ray.from, ray.direction);
  ray.length = far && ray.leaving > 0 ? far.distance : 0;
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

glm::vec3 SingleLight::sample(const Receiver& receiver, const EyeRay& ray, float u, int light) const {
  const Medium& medium = media_[size_t(receiver.hit.object)];
  if (medium.sigma_s == glm::vec3(0)) return glm::vec3(0);
  const Depth depth = Flights(medium.sigma_t, ray.length).draw(u);
  const glm::vec3 point = ray.from + depth.value * ray.direction;
  glm::vec3 sum(0);
  for (int l = 0; l < int(rays_.lights().size()); ++l)
    if (light < 0 || l == light)
      sum += arriving(receiver.hit.object, point, -ray.direction, rays_.lights()[size_t(l)]);
  return sum * medium.sigma_s * exp3(-medium.sigma_t * depth.value) * (ray.leaving / depth.density);
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
      radiance[all[i].pixel] += all[i].weight * sample(all[i], eyeRays_[i], std::fmin(u, 0.9999999f), light);
    }
  });
}

namespace {

constexpr int kTile = 4;         // pixels each way, whose samples fill a ray evenly
constexpr int kEdgeSamples = 2;  // of each of an edge's receivers
constexpr float kSameNormal = 0.9f, kSameDepth = 0.02f;

/// The place of a pixel's sample along the ray: in each of a tile's the middle of another sixteenth, near
/// ones far apart. Middles rather than random places: their error is smooth.
float placeOf(uint32_t column, uint32_t row) {
  constexpr int kOrder[kTile][kTile] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
  return (float(kOrder[row % kTile][column % kTile]) + 0.5f) / (kTile * kTile);
}

bool ofOneSurface(const Receiver& a, const Receiver& b) {
  return a.hit.object == b.hit.object && glm::dot(a.normal, b.normal) > kSameNormal &&
         std::fabs(a.depth - b.depth) < kSameDepth * a.depth;
}

}  // namespace

std::vector<glm::vec3> SingleLight::shared(const Progress& progress) const {
  progress.check({"single scattering", 0, ""});
  constexpr uint32_t kNone = ~0u;
  const auto& all = receivers_.receivers;
  const auto width = uint32_t(receivers_.width), height = uint32_t(receivers_.height);
  std::vector<glm::vec3> inside(all.size(), glm::vec3(0)), sum(receivers_.covered.size(), glm::vec3(0));
  std::vector<uint32_t> alone(sum.size(), kNone);  // the receiver of each pixel that has one
  tbb::parallel_for(size_t(0), all.size(), [&](size_t i) {
    if (all[i].weight == 1) alone[all[i].pixel] = uint32_t(i);
    if (!(eyeRays_[i].length > 0)) return;
    const float first = placeOf(all[i].pixel % width, all[i].pixel / width);
    const int samples = all[i].weight == 1 ? 1 : kEdgeSamples;
    for (int s = 0; s < samples; ++s) {
      // Of an edge's receivers, which follow each other, each begins elsewhere.
      const float u = first + (float(s) + 0.25f * float(i % 4)) / float(kEdgeSamples);
      inside[i] += sample(all[i], eyeRays_[i], samples == 1 ? first : u - std::floor(u), -1) / float(samples);
    }
    inside[i] /= eyeRays_[i].leaving;  // which is each pixel's own
  });
  const auto shareOf = [&](uint32_t i) {
    const uint32_t column = all[i].pixel % width, row = all[i].pixel / width;
    glm::vec3 mean(0);
    float weights = 0;
    for (int y = -kTile / 2; y <= kTile / 2; ++y)
      for (int x = -kTile / 2; x <= kTile / 2; ++x) {
        const uint32_t at = column + uint32_t(x), line = row + uint32_t(y);
        if (at >= width || line >= height) continue;
        const uint32_t other = alone[line * width + at];
        if (other == kNone || !(eyeRays_[other].length > 0) || !ofOneSurface(all[i], all[other])) continue;
        // Of the tile's two borders each counts half, so that every place along the ray counts alike.
        const float weight = (std::abs(x) == kTile / 2 ? 0.5f : 1) * (std::abs(y) == kTile / 2 ? 0.5f : 1);
        mean += weight * inside[other];
        weights += weight;
      }
    return mean / weights;
  };
  tbb::parallel_for(uint32_t(0), height, [&](uint32_t row) {
    for (uint32_t column = 0; column < width; ++column)
      if (const uint32_t i = alone[row * width + column]; i != kNone && eyeRays_[i].length > 0)
        sum[row * width + column] = eyeRays_[i].leaving * shareOf(i);
  });
  for (size_t i = 0; i < all.size(); ++i)
    if (alone[all[i].pixel] == kNone) sum[all[i].pixel] += all[i].weight * eyeRays_[i].leaving * inside[i];
  return sum;
}

std::vector<glm::vec3> SingleLight::mean(uint64_t passes, uint64_t seed, const Progress& progress) const {
  std::vector<glm::vec3> sum(receivers_.covered.size(), glm::vec3(0));
  for (uint64_t number = 0; number < passes; ++number) {
    progress.check({"single scattering", double(number) / double(passes), ""});
    pass(number, seed, -1, sum);
  }
  for (glm::vec3& s : sum) s /= float(passes);
  return sum;
}

}  // namespace lychnite
