#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "reference/ray_scene.h"
#include "reference/transport.h"

namespace lychnite {

/// Where photons start: the points of translucent surfaces that face a light, drawn in proportion to the
/// power that arrives there, so that no photon misses. A point in another surface's shadow is drawn too; its
/// photon dies.
class WalkEmission {
 public:
  explicit WalkEmission(const RayScene& rays);

  struct Start {
    RayHit hit;
    glm::vec3 toLight{0};     ///< unit
    float lightDistance = 0;  ///< infinite for parallel light
    glm::vec3 flux{
        0};  ///< arriving power, over the density; the mean over all starts is the power that arrives
  };
  /// The start for u in [0, 1): even u are even shares of the arriving power (estimated, see flux).
  Start start(double u, transport::Rng& rng) const;

  /// Draws starts in proportion to power times `importance` of their cell (WalkGuideSamples::cellOf).
  void guide(const std::vector<float>& importance);

  bool empty() const { return patches_.empty(); }
  /// Estimate of the arriving power without shadows, mean of RGB, scene units.
  double power() const { return total_; }

 private:
  struct Patch {
    uint32_t light, object, triangle;
    float share;  ///< of the starts
  };
  void addLight(const RayScene& rays, uint32_t light);
  void buildTable();

  const RayScene& rays_;
  std::vector<Patch> patches_;
  std::vector<double> before_;   ///< sum of the shares before each patch
  std::vector<uint32_t> guide_;  ///< first patch that reaches into each of evenly spaced steps of u
  double total_ = 0;
};

}  // namespace lychnite
