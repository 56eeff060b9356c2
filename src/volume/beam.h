#pragma once

#include "volume/emission.h"

namespace lychnite::volume {

/// The first collisions of a light of power 1, without noise: from each node that it reaches one straight
/// beam carries all that enters the node through the object, mirrored where it meets the surface again. What
/// collides goes to the diffusion equation at once, as in the isotropic medium of equal sigma_sp. Light that
/// leaves without a collision is not followed.
struct Beamed {
  std::vector<Deposits>
      deposits;  ///< of each body; `first` by a few looks along each beam, not taken out of `later`
  Tally tally;
};
/// `entering` are the fluxes that enter the nodes of each body, and through which sample.
Beamed beamLight(const World& world, const RayLight& light, const std::vector<Entering>& entering);

}  // namespace lychnite::volume
