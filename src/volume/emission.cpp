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

// Of what a node would get, where its one look at the light is blocked: parts of it may not be.
constexpr float kLeastDensity = 0.2f;

// Of the photons, that start as light enters whatever counts: light also takes ways that an aim does not
// know.
constexpr double kUnaimed = 0.2;

constexpr double kChannelStep = 0.41421356237309503;  // of a recurrence of its own

float turn(double x) {
  return std::fmin(float(x - std::floor(x)), 0.99999994f);
}

}  // namespace

Emission::Emission(const Surface& surface, const Entering& entering, const std::vector<float>& importance,
                   int points) {
  const auto& samples = surface.samples();
  const auto& nodes = surface.nodes();
  std::vector<double> density(nodes.size(), 0);
  double total = 0, aimed = 0, all = 0;
  for (size_t n = 0; n < importance.size(); ++n) {
    aimed += double(entering.flux[n]) * double(importance[n]);
    all += double(entering.flux[n]);
  }
  for (size_t n = 0; n < nodes.size(); ++n) {
    if (!(nodes[n].area > 0)) continue;
    density[n] = double(std::fmax(entering.flux[n], kLeastDensity * entering.unshaded[n]) / nodes[n].area);
    if (aimed > 0) density[n] *= kUnaimed + (1 - kUnaimed) * double(importance[n]) * all / aimed;
  }
  for (const auto& sample : samples) total += double(sample.area) * density[sample.node];
  if (!(total > 0)) return;
  double squares = 0;
  for (const auto& sample : samples)
    squares += double(sample.area) * density[sample.node] * density[sample.node];
  density_ = points * squares / (total * total);
  points_.reserve(size_t(points));
  double before = 0;
  uint32_t sample = 0;
  const auto share = [&] { return double(samples[sample].area) * density[samples[sample].node]; };
  for (int i = 0; i < points; ++i) {
    const double at = (i + 0.5) * total / points;
    while (sample + 1 < samples.size() && before + share() <= at) {
      before += share();
      ++sample;
    }
    if (!(share() > 0)) continue;
    points_.push_back({sample, turn(0.5 + i * kStep[0]), turn(0.5 + i * kStep[1]),
                       float(total / points / density[samples[sample].node])});
  }
}

namespace {

/// One pass of photons of one light onto one body.
struct Pass {
  const World& world;
  const Emission& emission;
  RayLight light;
  size_t object;
  int collisions;
  uint64_t seed;
  int number;
  float shift[6];

  void follow(Tracer& tracer, size_t i) const {
    const Body& body = *world.bodies[object];
    const auto& point = emission.points()[i];
    const Surface& surface = body.shape->surface;
    const glm::vec2 at =
        surface.pointOf(point.sample, turn(double(point.x + shift[0])), turn(double(point.y + shift[1])));
    const RayHit hit =
        world.rays->hitOf(int(object), surface.samples()[point.sample].triangle, at.x, at.y, 0);
    const RayLight::Seen seen = light.seenFrom(hit.position);
    const glm::vec3 towards(seen.direction);
    const float cosine = glm::dot(towards, hit.normal);
    if (cosine <= 0) return;
    if (world.rays->occluded(offPoint(hit, towards), towards, float(seen.distance))) return;
    const float area = point.area * body.size * body.size;
    const double n = double(i);
    const glm::vec3 u(turn(n * kStep[2] + double(shift[2])), turn(n * kStep[3] + double(shift[3])),
                      turn(n * kStep[4] + double(shift[4])));
    const uint64_t stream = (uint64_t(number) << 32) + object * emission.points().size() + i;
    tracer.arrive(hit, -towards, glm::vec3(seen.irradiance) * (cosine * area),
                  turn(n * kChannelStep + double(shift[5])), u, Rng(seed, stream), 0, collisions);
  }
};

RayLight unitPower(const RayLight& light) {
  RayLight unit = light;
  unit.power = Rgb(1);
  return unit;
}

}  // namespace

Traced traceLight(const World& world, const std::vector<Emission>& emission, const RayLight& light,
                  int collisions, uint64_t seed, int pass) {
  Traced result;
  for (auto& half : result.deposits)
    for (const auto& body : world.bodies) half.push_back(body ? Deposits(*body) : Deposits());
  for (size_t object = 0; object < world.bodies.size(); ++object) {
    if (!world.bodies[object]) continue;
    Pass one{world, emission[object], unitPower(light), object, collisions, seed, pass, {}};
    // Later passes shift all points and numbers (Cranley & Patterson 1976).
    Rng shifts(seed, uint64_t(pass));
    for (float& s : one.shift) s = pass > 0 ? shifts.uniform() : 0;
    const size_t count = emission[object].points().size();
    const size_t blocks = (count + kBlock - 1) / kBlock;
    std::vector<std::vector<Tracer::Record>> records(2 * blocks);
    std::vector<Tally> tallies(2 * blocks);
    tbb::parallel_for(size_t(0), 2 * blocks, [&](size_t b) {
      Tracer tracer(world, records[b]);
      const size_t begin = b / 2 * kBlock + b % 2;
      for (size_t i = begin; i < std::min(count, (b / 2 + 1) * kBlock); i += 2) one.follow(tracer, i);
      tallies[b] = tracer.tally();
    });
    for (size_t b = 0; b < 2 * blocks; ++b) {
      collect(records[b], result.deposits[b % 2]);
      result.tally += tallies[b];
    }
  }
  return result;
}

RayHit middleOf(const World& world, size_t object, uint32_t sample) {
  const Surface& surface = world.bodies[object]->shape->surface;
  const glm::vec2 at = surface.pointOf(sample, 1.0f / 3, 1.0f / 3);
  return world.rays->hitOf(int(object), surface.samples()[sample].triangle, at.x, at.y, 0);
}

namespace {

/// Flux that enters each sample if nothing shades it, and each node's sample that gets most.
struct Unshaded {
  std::vector<float> samples;
  std::vector<uint32_t> brightest;
};

Unshaded unshadedFlux(const World& world, size_t object, const RayLight& light) {
  const Body& body = *world.bodies[object];
  const auto& samples = body.shape->surface.samples();
  Unshaded result{std::vector<float>(samples.size(), 0),
                  std::vector<uint32_t>(body.shape->surface.nodes().size(), Grid::kNone)};
  tbb::parallel_for(size_t(0), samples.size(), [&](size_t s) {
    const RayLight::Seen seen = light.seenFrom(body.toScene(samples[s].position));
    const float cosine =
        std::fmin(1.0f, glm::dot(body.turnBack * glm::vec3(seen.direction), samples[s].normal));
    if (cosine <= 0) return;
    const float T = 1 - transport::fresnel(cosine, body.medium.eta).reflectance;
    result.samples[s] = float(seen.irradiance.x) * cosine * T * samples[s].area * body.size * body.size;
  });
  for (uint32_t s = 0; s < samples.size(); ++s) {
    uint32_t& best = result.brightest[samples[s].node];
    if (result.samples[s] > 0 && (best == Grid::kNone || result.samples[s] > result.samples[best])) best = s;
  }
  return result;
}

}  // namespace

std::vector<Entering> enteringFlux(const World& world, const RayLight& light) {
  const RayLight unit = unitPower(light);
  std::vector<Entering> result(world.bodies.size());
  for (size_t object = 0; object < world.bodies.size(); ++object) {
    if (!world.bodies[object]) continue;
    const auto& samples = world.bodies[object]->shape->surface.samples();
    Unshaded unshaded = unshadedFlux(world, object, unit);
    const size_t nodes = unshaded.brightest.size();
    std::vector<char> lit(nodes, 0);
    tbb::parallel_for(size_t(0), nodes, [&](size_t n) {
      if (unshaded.brightest[n] == Grid::kNone) return;
      const RayHit hit = middleOf(world, object, unshaded.brightest[n]);
      const RayLight::Seen seen = unit.seenFrom(hit.position);
      const glm::vec3 towards(seen.direction);
      lit[n] = !world.rays->occluded(offPoint(hit, towards), towards, float(seen.distance));
    });
    result[object].unshaded.assign(nodes, 0);
    for (uint32_t s = 0; s < samples.size(); ++s)
      result[object].unshaded[samples[s].node] += unshaded.samples[s];
    result[object].flux = result[object].unshaded;
    for (size_t n = 0; n < nodes; ++n)
      if (!lit[n]) result[object].flux[n] = 0;
    result[object].brightest = std::move(unshaded.brightest);
  }
  return result;
}

}  // namespace lychnite::volume
