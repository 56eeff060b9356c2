#pragma once

#include "volume/photons.h"

namespace lychnite::volume {

/// Where photons start: points spread evenly over the surface of a body, the same for every light, so that
/// each point's light changes smoothly when the light moves.
class Emission {
 public:
  Emission() = default;
  Emission(const Surface& surface, int points);

  struct Point {
    uint32_t sample;
    float x, y;  ///< in the sample, in [0, 1)
  };
  const std::vector<Point>& points() const { return points_; }
  double areaEach() const { return areaEach_; }  ///< local units

 private:
  std::vector<Point> points_;
  double areaEach_ = 0;
};

/// What a light of power 1 (irradiance, or intensity in scene units) leaves in each body: pass number `pass`
/// of photons. Each pass has its own random numbers, always the same.
struct Traced {
  std::vector<Deposits> deposits[2];  ///< of every other photon
  Tally tally;                        ///< of all
};
Traced traceLight(const World& world, const std::vector<Emission>& emission, const RayLight& light,
                  int collisions, uint64_t seed, int pass);

/// Flux of a light of power 1 that enters each node of a body, straight from the light: the samples' cosines
/// and Fresnel terms, and one look for shadows a node, from the sample that gets most.
struct Entering {
  std::vector<float> flux;
  std::vector<uint32_t> brightest;  ///< sample of each node; kNone where all turn away from the light
};
std::vector<Entering> enteringFlux(const World& world, const RayLight& light);

/// The middle of a sample, scene units.
RayHit middleOf(const World& world, size_t object, uint32_t sample);

}  // namespace lychnite::volume
