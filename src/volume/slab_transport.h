#pragma once

#include <array>
#include <vector>

#include "volume/diffusion.h"

namespace lychnite::volume {

/// How much stronger first collisions have to be as sources of the diffusion equation for as much light to
/// leave as transport says, in a half-space of the isotropic medium lit by a refracted beam. In a slab that
/// follows from what diffusion absorbs there, so that nothing changes where nothing is absorbed. Depends on
/// albedo and index alone, lengths are mean free paths (docs/volume.md).
class SlabTransport {
 public:
  static constexpr int kThicknesses = 20, kCosines = 8;

  SlabTransport() = default;
  /// Of the reduced medium; `eta` inside over outside.
  SlabTransport(const Diffusion& medium, double eta);

  /// Strength less 1, for a beam at `cosine` to the normal into a slab of `thickness` mean free paths.
  float excess(float thickness, float cosine) const;

  /// Of what enters a half-space at `cosine` inside, the share that leaves after scattering: transport, no
  /// diffusion. Of a slab of 16 mean free paths, in truth.
  static double reflectance(double albedo, double eta, double cosine);

 private:
  float leastCosine_ = 0;
  std::vector<std::array<float, kCosines>> table_;
};

}  // namespace lychnite::volume
