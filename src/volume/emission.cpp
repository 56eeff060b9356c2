#include "volume/emission.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace lychnite::volume {

namespace {

using transport::Rng;

constexpr size_t kBlock = 2048;

/// The additive recurrence of Roberts 2018 in five dimensions: powers of 1/phi, phi^6 = phi + 1.
constexpr double kStep[5] = {0.8812714616335696, 0.7766393890897682, 0.6844301295853426, 0.6031687406857282,
                             0.5315553977157913};

float turn(double x) {
  return std::fmin(float(x - std::floor(x)), 0.99999994f);
}

}  // namespace

Emission::Emission(const Surface& surface, int points) : areaEach_(surface.area() / points) {
  points_.reserve(size_t(points));
  const auto& samples = surface.samples();
  double before = 0;
  uint32_t sample = 0;
  for (int i = 0; i < points; ++i) {
    const double at = (i + 0.5) * areaEach_;
    while (sample + 1 < samples.size() && before + double(samples[sample].area) <= at)
      before += double(samples[sample++].area);
    points_.push_back({sample, turn(0.5 + i * kStep[0]), turn(0.5 + i * kStep[1])});
  }
}

Traced traceLight(const World& world, const std::vector<Emission>& emission, const RayLight& light,
                  int collisions, uint64_t seed, int pass) {
  Traced result;
  RayLight unit = light;
  unit.power = Rgb(1);
  // Later passes shift all points and numbers (Cranley & Patterson 1976).
  Rng shifts(seed, uint64_t(pass));
  float shift[5];
  for (float& s : shift) s = pass == 0 ? 0 : shifts.uniform();
  for (const auto& body : world.bodies) result.deposits.push_back(body ? Deposits(*body) : Deposits());
  for (size_t object = 0; object < world.bodies.size(); ++object) {
    if (!world.bodies[object]) continue;
    const Body& body = *world.bodies[object];
    const auto& points = emission[object].points();
    const float area = float(emission[object].areaEach()) * body.size * body.size;
    const size_t blocks = (points.size() + kBlock - 1) / kBlock;
    std::vector<std::vector<Tracer::Record>> records(blocks);
    std::vector<Tally> tallies(blocks);
    tbb::parallel_for(size_t(0), blocks, [&](size_t b) {
      Tracer tracer(world, records[b]);
      for (size_t i = b * kBlock; i < std::min(points.size(), (b + 1) * kBlock); ++i) {
        const auto& sample = body.shape->surface.samples()[points[i].sample];
        const glm::vec2 at = body.shape->surface.pointOf(
            points[i].sample, turn(double(points[i].x + shift[0])), turn(double(points[i].y + shift[1])));
        const RayHit hit = world.rays->hitOf(int(object), sample.triangle, at.x, at.y, 0);
        const RayLight::Seen seen = unit.seenFrom(hit.position);
        const glm::vec3 towards(seen.direction);
        const float cosine = glm::dot(towards, hit.normal);
        if (cosine <= 0) continue;
        if (world.rays->occluded(offPoint(hit, towards), towards, float(seen.distance))) continue;
        const glm::vec3 flux = glm::vec3(seen.irradiance) * (cosine * area);
        const double n = double(i);
        const glm::vec3 u(turn(n * kStep[2] + double(shift[2])), turn(n * kStep[3] + double(shift[3])),
                          turn(n * kStep[4] + double(shift[4])));
        tracer.arrive(hit, -towards, flux, int((i + size_t(pass)) % 3), u,
                      Rng(seed, (uint64_t(pass) << 32) + object * points.size() + i), 0, collisions);
      }
      tallies[b] = tracer.tally();
    });
    for (size_t b = 0; b < blocks; ++b) {
      collect(records[b], result.deposits);
      result.tally += tallies[b];
    }
  }
  return result;
}

std::vector<std::vector<float>> enteringFlux(const World& world, const RayLight& light) {
  RayLight unit = light;
  unit.power = Rgb(1);
  std::vector<std::vector<float>> result(world.bodies.size());
  for (size_t object = 0; object < world.bodies.size(); ++object) {
    if (!world.bodies[object]) continue;
    const Body& body = *world.bodies[object];
    const Surface& surface = body.shape->surface;
    const auto& samples = surface.samples();
    std::vector<float> each(samples.size(), 0), best(surface.nodes().size(), 0);
    std::vector<uint32_t> brightest(best.size(), 0);
    const auto hitOf = [&](size_t s) {
      const glm::vec2 at = surface.pointOf(uint32_t(s), 1.0f / 3, 1.0f / 3);
      return world.rays->hitOf(int(object), samples[s].triangle, at.x, at.y, 0);
    };
    tbb::parallel_for(size_t(0), (samples.size() + kBlock - 1) / kBlock, [&](size_t b) {
      for (size_t s = b * kBlock; s < std::min(samples.size(), (b + 1) * kBlock); ++s) {
        const RayHit hit = hitOf(s);
        const RayLight::Seen seen = unit.seenFrom(hit.position);
        const float cosine = std::fmin(1.0f, glm::dot(glm::vec3(seen.direction), hit.normal));
        if (cosine <= 0) continue;
        const float T = 1 - transport::fresnel(cosine, body.medium.eta).reflectance;
        each[s] = float(seen.irradiance.x) * cosine * T * samples[s].area * body.size * body.size;
      }
    });
    for (uint32_t s = 0; s < samples.size(); ++s)
      if (each[s] > best[samples[s].node]) best[samples[s].node] = each[s], brightest[samples[s].node] = s;
    std::vector<char> lit(best.size(), 0);
    tbb::parallel_for(size_t(0), (best.size() + kBlock - 1) / kBlock, [&](size_t b) {
      for (size_t n = b * kBlock; n < std::min(best.size(), (b + 1) * kBlock); ++n) {
        if (!(best[n] > 0)) continue;
        const RayHit hit = hitOf(brightest[n]);
        const RayLight::Seen seen = unit.seenFrom(hit.position);
        const glm::vec3 towards(seen.direction);
        lit[n] = !world.rays->occluded(offPoint(hit, towards), towards, float(seen.distance));
      }
    });
    result[object].assign(best.size(), 0);
    for (uint32_t s = 0; s < samples.size(); ++s)
      if (lit[samples[s].node]) result[object][samples[s].node] += each[s];
  }
  return result;
}

}  // namespace lychnite::volume
