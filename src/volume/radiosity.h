#pragma once

#include "volume/smooth.h"

namespace lychnite::volume {

/// What is known of the light that leaves a body, flux per node.
struct NodeEstimate {
  std::vector<Lanes> entering;  ///< flux that enters
  std::vector<Lanes> beam;      ///< by first collisions alone, without noise
  std::vector<Lanes> again;     ///< light that left before and entered again
  std::vector<Lanes> half[2];   ///< two estimates from independent photons; empty without photons
  double photons = 1;           ///< starting points per voxel's face of surface, both halves
};

/// Cleaned of the photons' noise.
struct NodeFlux {
  std::vector<Lanes> flux;
  std::vector<Lanes> variance;  ///< of the noise that is left in the flux; empty without photons
};

/// Light of the first order, flux per node: by a few looks along the beams, and by the photons' halves, which
/// are empty without photons; `response` as of cleaned().
struct FirstOrder {
  std::vector<Lanes> flux, half[2];
  Smoother::Response response;
};

/// What a half-space of the medium makes of the entering flux (`response` to light of wave number q, radians
/// per voxel) and what first collisions make of it in the shape are known without noise; what the photons
/// differ from them is smoothed, at each place as widely as it bears, which the two halves tell
/// (docs/volume.md). Less the first order where that is given, known in the same way.
NodeFlux cleaned(const Smoother& smoother, const Surface& surface, const NodeEstimate& estimate,
                 const Smoother::Response& response, const FirstOrder* first);

/// Of an edge in what enters, the share that leaves at once with its detail that nodes are too coarse to
/// tell: the a of least square error between a (1 - K) and (1 - K) response, K what nodes and Gather keep,
/// over the spectrum of edges, q^-3; but not more than the response to the shortest wave that the picture
/// shows, `finest` radians per voxel, so that no edge is sharper than it should be. 0 where it is next to
/// nothing.
glm::vec3 fineShare(const Smoother::Response& response, double finest);

/// The first order alone, likewise.
std::vector<Lanes> cleanedFirst(const Smoother& smoother, const Surface& surface,
                                const NodeEstimate& estimate, const FirstOrder& first);

}  // namespace lychnite::volume
