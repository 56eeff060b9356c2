#pragma once

#include <array>
#include <vector>

#include "volume/diffusion.h"

namespace lychnite::volume {

/// How much stronger a source of the diffusion equation has to be for as much light to leave as transport
/// says, in a half-space of the isotropic medium. In a slab that follows from what diffusion absorbs there,
/// so that nothing changes where nothing is absorbed. Depends on albedo and index alone, lengths are mean
/// free paths (docs/volume.md).
class SlabTransport {
 public:
  static constexpr int kThicknesses = 20, kDepths = 12;

  SlabTransport() = default;
  /// Of the reduced medium; `eta` inside over outside.
  SlabTransport(const Diffusion& medium, double eta);

  /// Strength less 1, of light scattered `depth` mean free paths under the nearer side of a slab of
  /// `thickness`.
  float excess(float thickness, float depth) const;

  /// Of what enters a half-space at `cosine` inside, the share that leaves after scattering: transport, no
  /// diffusion. Of a slab of 16 mean free paths, in truth.
  static double reflectance(double albedo, double eta, double cosine);

 private:
  std::vector<std::array<float, kDepths>> table_;
};

}  // namespace lychnite::volume
