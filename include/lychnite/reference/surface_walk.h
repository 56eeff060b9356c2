#pragma once

#include <cstdint>
#include <vector>

#include "lychnite/base/log.h"
#include "lychnite/base/progress.h"
#include "lychnite/mesh/mesh.h"
#include "lychnite/scene/scene.h"

namespace lychnite {

struct SurfaceWalkSettings {
  size_t patches = 4000;  ///< of each object's surface, of equal area, 1..2^24
  double photons = 1e6;   ///< at least 1
  double timeLimit = 0;   ///< seconds, in place of the photons; 0 = none
  double noise = 0;       ///< of the result to stop at, in place of the photons; 0 = none
  uint64_t seed = 1;
  int threads = 0;  ///< 0 = all cores
};

/// The truth on all of the surface, seen or not.
struct SurfaceWalkResult {
  /// Radiosity (scattered light of all orders that leaves, over area; in units of irradiance) of each object
  /// and patch, by two independent halves of the photons: their difference tells the noise. Empty for opaque
  /// objects.
  std::vector<std::vector<Rgb>> radiosity[2];
  double photons = 0, seconds = 0;
  /// Of one half: standard error over mean, root mean square over the patches of all objects, RGB together,
  /// as the halves' difference tells it.
  double noise = 0;
};

/// Monte Carlo transport by the walk's own photons (`--method walk`; docs/physics.md says what is exact in
/// it), tallied where light leaves instead of in a camera. With both a time limit and a noise it stops at
/// whichever comes first. Same settings without a time limit, same result, whatever the threads. Throws
/// Error, Interrupted.
SurfaceWalkResult surfaceWalk(const Scene& scene, const SurfaceWalkSettings& settings,
                              const Progress& progress = {}, const LogSink& log = {});

/// `each` random points in each of an object's patches, patch after patch: means over them are what stands
/// beside the walk's. The same for the same seed.
std::vector<MeshPoint> patchPoints(const Scene& scene, int object, size_t patches, size_t each,
                                   uint64_t seed = 1);

}  // namespace lychnite
