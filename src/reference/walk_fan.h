#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "reference/ray_scene.h"

namespace lychnite {

/// Rays inside an object that are traced together. Entries past `count` are not used.
struct RayFan {
  static constexpr int kMost = 8;
  int count = 0;
  std::array<glm::vec3, kMost> from;
  std::array<glm::vec3, kMost> direction;  ///< unit
  std::array<RayHit, kMost> hit;
  std::array<glm::vec3, kMost> first;  ///< direction before any mirroring
  std::array<float, kMost> before;     ///< length flown before `from`
  std::array<float, kMost> weight;     ///< share of the flux, but for attenuation
};

/// Nearest surfaces for light inside `object`.
void traceInside(const RayScene& rays, int object, RayFan& fan);

/// Sight lines that are tested together.
struct SightFan {
  int count = 0;
  std::array<glm::vec3, RayFan::kMost> from, direction;
  std::array<float, RayFan::kMost> distance;
  std::array<bool, RayFan::kMost> blocked;
};
void traceSight(const RayScene& rays, SightFan& fan);

}  // namespace lychnite
