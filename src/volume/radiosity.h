#pragma once

#include "volume/smooth.h"

namespace lychnite::volume {

/// What is known of the light that leaves a body, flux per node: two estimates from independent photons, and
/// the flux that enters.
struct NodeEstimate {
  std::vector<Lanes> half[2];
  std::vector<Lanes> entering;
  double photons = 1;  ///< starting points per voxel's face of surface, both halves
};

/// Cleaned of the photons' noise.
struct NodeFlux {
  std::vector<Lanes> flux;
  std::vector<Lanes> variance;  ///< of the noise that is left in the flux; empty
                                ///< from cleanedQuickly()
};

/// What a half-space of the medium makes of the entering flux is known without noise (`response` to entering
/// light of wave number q, radians per voxel); what is left is smoothed, at each place as widely as it bears,
/// which the two halves tell (docs/volume.md).
NodeFlux cleaned(const Smoother& smoother, const Surface& surface, const NodeEstimate& estimate,
                 const Smoother::Response& response);

/// The same with one width everywhere: a fifth of the time.
NodeFlux cleanedQuickly(const Smoother& smoother, const NodeEstimate& estimate,
                        const Smoother::Response& response);

}  // namespace lychnite::volume
