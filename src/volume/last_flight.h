#pragma once

#include "volume/photons.h"

namespace lychnite::volume {

/// The last flight of light out to the surface, where cells are thinner than mean free paths: diffusion knows
/// no detail of the surface below a mean free path, straight lines do. A few rays go inwards from each node,
/// within the cone that can leave, and gather what the fluence along them scatters towards the node.
class LastFlight {
 public:
  LastFlight(const World& world, size_t object);
  float eta() const { return eta_; }

  /// Flux that leaves at each node, by fluence and sources of the cells, in place of `exits`, which is what
  /// diffusion says: its sum is kept. Channels whose cells are thicker than mean free paths are left as they
  /// are.
  void gather(const Body& body, const std::vector<Lanes>& phi, const std::vector<Lanes>& Q,
              std::vector<Lanes>& exits) const;
  size_t memoryBytes() const { return rays_.capacity() * sizeof(Ray); }

 private:
  struct Ray {
    glm::vec3 from{0}, direction{0};  ///< local units
    float length = 0;
    float transmittance = 0;     ///< at the node, of what comes along the ray
    float mirrored = 0;          ///< at the far end
    uint32_t end = Grid::kNone;  ///< cell at the far end
  };
  float eta_ = 1;
  std::vector<Ray> rays_;  ///< kRays for each node
};

}  // namespace lychnite::volume
