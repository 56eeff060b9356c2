#pragma once

#include "volume/photons.h"

namespace lychnite::volume {

/// Flux of a light of power 1 that enters each node of a body, straight from the light: the samples' cosines
/// and Fresnel terms, and one look for shadows a node, from the sample that gets most.
struct Entering {
  std::vector<float> flux;
  std::vector<float> unshaded;      ///< if nothing shaded it
  std::vector<uint32_t> brightest;  ///< sample of each node; kNone where all turn away from the light
};
std::vector<Entering> enteringFlux(const World& world, const RayLight& light);

/// Where photons of a light start on a body: as many on an area as light enters it, most of them times what a
/// photon there counts for (`importance` of each node, up to a factor; empty for 1).
class Emission {
 public:
  Emission() = default;
  Emission(const Surface& surface, const Entering& entering, const std::vector<float>& importance,
           int points);

  struct Point {
    uint32_t sample;
    float x, y;  ///< in the sample, in [0, 1)
    float area;  ///< that it stands for, local units
  };
  const std::vector<Point>& points() const { return points_; }
  /// Per area, local units, where the light comes in that counts.
  double density() const { return density_; }

 private:
  std::vector<Point> points_;
  double density_ = 0;
};

/// What a light of power 1 (irradiance, or intensity in scene units) leaves in each body: pass number `pass`
/// of photons. Each pass has its own random numbers, always the same.
struct Traced {
  std::vector<Deposits> deposits[2];  ///< of every other photon
  Tally tally;                        ///< of all
};
Traced traceLight(const World& world, const std::vector<Emission>& emission, const RayLight& light,
                  int collisions, uint64_t seed, int pass);

/// The middle of a sample, scene units.
RayHit middleOf(const World& world, size_t object, uint32_t sample);

}  // namespace lychnite::volume
