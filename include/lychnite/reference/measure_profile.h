#pragma once

#include <cstdint>

#include "lychnite/base/progress.h"
#include "lychnite/optics/tabulated_profile.h"

namespace lychnite {

struct ProfileMeasurement {
  Rgb albedo{0};  ///< sigma_s / sigma_t, in [0, 1]
  double g = 0, eta = 1.3;
  uint64_t photons = 1'500'000;
  uint64_t seed = 1;
};

/// Measures the profile of a half-space by the transport of simulateSlab, with a pencil beam whose directions
/// are cosine-distributed: over a convex body in parallel light, all orientations taken together, entering
/// light has exactly these directions. The three channels share their paths. Throws Error (Kind::kUsage) for
/// numbers out of range, Interrupted.
MeasuredProfile measureProfile(const ProfileMeasurement& measurement, const Progress& progress = {});

}  // namespace lychnite
