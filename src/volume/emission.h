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
/// of photons, from one of `oneOf` points only, each of which stands for itself: what comes out is so much
/// less. Each pass has its own random numbers, always the same.
struct Traced {
  std::vector<Deposits> deposits[2];  ///< of every other photon
  Tally tally;                        ///< of all
};
Traced traceLight(const World& world, const std::vector<Emission>& emission, const RayLight& light,
                  int collisions, uint64_t seed, int pass, int oneOf);

/// Flux of a light of power 1 that enters each node of each body, straight from the light: the samples'
/// cosines and Fresnel terms, and one look for shadows a node.
std::vector<std::vector<float>> enteringFlux(const World& world, const RayLight& light);

}  // namespace lychnite::volume
