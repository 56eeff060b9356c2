#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "lychnite/base/progress.h"
#include "lychnite/optics/coefficients.h"

namespace lychnite {

/// A plane slab of one medium with smooth surfaces, the same outside medium on both sides, lit from above.
struct SlabSettings {
  Coefficients medium;
  double thickness = std::numeric_limits<double>::infinity();  ///< mm, > 0; infinite for a half-space
  double incidenceDegrees = 0;  ///< of collimated light from the normal, in [0, 90)
  bool diffuse = false;         ///< cosine-distributed incidence instead
  uint64_t photons = 1'000'000;
  uint64_t seed = 1;
  int threads = 0;  ///< 0 = all cores
  /// Rings of the radial tables, mm, rising from 0 or more; ring i spans [ringEdges[i], ringEdges[i + 1]).
  /// Empty for none.
  std::vector<double> ringEdges;
};

/// A share of the incident power per channel, and its standard error.
struct SlabShare {
  Rgb value{0}, standardError{0};
};

/// Where the power of the incident light goes. diffuse_reflectance + specular_reflectance +
/// total_transmittance + absorbed = 1 up to the errors.
struct SlabResult {
  SlabShare diffuse_reflectance;   ///< out of the top, except what the top mirrors; so with the little
                                   ///< that the bottom mirrors unscattered, as in MCML (Wang et al. 1995)
  SlabShare specular_reflectance;  ///< mirrored by the top
  SlabShare total_transmittance;   ///< out of the bottom
  SlabShare unscattered_transmittance;  ///< the part of it that was never scattered
  SlabShare absorbed;
  /// Exitance around a pencil beam, per unit power, 1/mm^2, mean over each ring, scattered light only.
  std::vector<SlabShare> radialReflectance, radialTransmittance;
  /// The part of radialReflectance, and of its power in all rings and beyond, that was scattered but once.
  std::vector<SlabShare> radialReflectanceOnce;
  SlabShare reflectance_once;
  double seconds = 0;
};

/// Monte Carlo transport through the slab, by the same flights, phase function, boundary and weights as the
/// walk. The unscattered light is computed in closed form (for diffuse incidence by quadrature; standard
/// error 0); photons only carry what is scattered. Same seed, same result, whatever the threads. Throws Error
/// (Kind::kUsage) for settings out of range, Interrupted when `progress` says stop.
SlabResult simulateSlab(const SlabSettings& settings, const Progress& progress = {});

}  // namespace lychnite
