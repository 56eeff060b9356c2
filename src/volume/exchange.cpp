#include "volume/exchange.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "lychnite/optics/fresnel.h"

namespace lychnite::volume {

namespace {

using transport::Rng;

constexpr int kRays = 2;  // of a node
constexpr size_t kBlock = 1024;
constexpr uint64_t kStream = uint64_t(1) << 40;

/// Even numbers: the golden-ratio sequences of one and two dimensions.
float turn(double x) {
  return float(x - std::floor(x));
}

}  // namespace

Exchange::Exchange(const World& world) {
  for (size_t object = 0; object < world.bodies.size(); ++object) {
    if (!world.bodies[object]) continue;
    const Body& body = *world.bodies[object];
    const Surface& surface = body.shape->surface;
    // A node's rays start from its samples, taken in turn.
    std::vector<uint32_t> sampleOf(surface.nodes().size(), 0);
    for (uint32_t s = 0; s < surface.samples().size(); ++s) sampleOf[surface.samples()[s].node] = s;
    const size_t blocks = (sampleOf.size() + kBlock - 1) / kBlock;
    std::vector<std::vector<Pair>> found(blocks);
    tbb::parallel_for(size_t(0), blocks, [&](size_t b) {
      for (size_t n = b * kBlock; n < std::min(sampleOf.size(), (b + 1) * kBlock); ++n) {
        const auto& sample = surface.samples()[sampleOf[n]];
        const glm::vec2 at = surface.pointOf(sampleOf[n], 1.0f / 3, 1.0f / 3);
        const RayHit from = world.rays->hitOf(int(object), sample.triangle, at.x, at.y, 0);
        for (int i = 0; i < kRays; ++i) {
          const double index = double(n) * kRays + i;
          const float u = turn(0.5 + index * 0.7548776662466927), v = turn(0.5 + index * 0.5698402909980532);
          const float cosine = std::sqrt(1 - u);
          const glm::vec3 direction = transport::deflected(from.normal, cosine, 2 * transport::kPi * v);
          const RayHit hit = world.rays->nearest(offPoint(from, direction), direction);
          if (!hit || !world.bodies[size_t(hit.object)] || glm::dot(hit.normal, direction) >= 0) continue;
          found[b].push_back({uint32_t(n), uint16_t(object), cosine, hit, direction});
        }
      }
    });
    for (const auto& part : found) pairs_.insert(pairs_.end(), part.begin(), part.end());
  }
}

std::vector<Deposits> Exchange::send(const World& world, const std::vector<std::vector<Lanes>>& leaving,
                                     int collisions, uint64_t seed, int round, int oneOf,
                                     Tally& tally) const {
  // Leaving light has the angular shape S_w (docs/physics.md); over the rays' density that is Ft / C.
  std::vector<double> C(world.bodies.size(), 1), eta(C);
  for (size_t i = 0; i < C.size(); ++i)
    if (world.bodies[i]) {
      eta[i] = double(world.bodies[i]->medium.eta);
      C[i] = diffuseTransmittanceOutside(eta[i]);
    }
  const size_t blocks = (pairs_.size() + kBlock - 1) / kBlock;
  std::vector<std::vector<Tracer::Record>> records(blocks);
  std::vector<Tally> tallies(blocks);
  tbb::parallel_for(size_t(0), blocks, [&](size_t b) {
    Tracer tracer(world, records[b]);
    for (size_t i = b * kBlock; i < std::min(pairs_.size(), (b + 1) * kBlock); i += size_t(oneOf)) {
      const Pair& pair = pairs_[i];
      const Lanes& all = leaving[pair.object][pair.node];
      const auto share = float(fresnelTransmittance(double(pair.cosine), eta[pair.object]) * oneOf /
                               (C[pair.object] * kRays));
      const glm::vec3 flux = glm::vec3(all[0], all[1], all[2]) * share;
      if (!(flux.x + flux.y + flux.z > 0)) continue;
      Rng rng(seed, kStream * uint64_t(1 + round) + i);
      const glm::vec3 u(rng.uniform(), rng.uniform(), rng.uniform());
      tracer.arrive(pair.hit, pair.direction, flux, rng.uniform(), u, rng, 2, collisions);
    }
    tallies[b] = tracer.tally();
  });
  std::vector<Deposits> deposits;
  for (const auto& body : world.bodies) deposits.push_back(body ? Deposits(*body) : Deposits());
  for (size_t b = 0; b < blocks; ++b) {
    collect(records[b], deposits);
    tally += tallies[b];
  }
  return deposits;
}

}  // namespace lychnite::volume
