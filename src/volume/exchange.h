#pragma once

#include "volume/photons.h"

namespace lychnite::volume {

/// Light that leaves a surface and meets another: found once for a scene's shapes by rays from every node,
/// cosine-distributed about its normal.
class Exchange {
 public:
  explicit Exchange(const World& world);

  struct Pair {
    uint32_t node;
    uint16_t object;
    float cosine;  ///< of leaving
    RayHit hit;
    glm::vec3 direction;
  };
  bool empty() const { return pairs_.empty(); }
  size_t memoryBytes() const { return pairs_.capacity() * sizeof(Pair); }

  /// Sends the flux that leaves at nodes (per body) back in where it meets a surface, as scattered light, by
  /// one of `oneOf` rays. Each `round` has random numbers of its own. Returns what it deposits.
  std::vector<Deposits> send(const World& world, const std::vector<std::vector<Lanes>>& leaving,
                             int collisions, uint64_t seed, int round, int oneOf, Tally& tally) const;

 private:
  std::vector<Pair> pairs_;
};

}  // namespace lychnite::volume
