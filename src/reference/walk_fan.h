#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "reference/ray_scene.h"

namespace lychnite {

/// Rays that are traced together. Entries past `count` are not used.
struct RayFan {
  static constexpr int kMost = 8;
  int count = 0;
  std::array<glm::vec3, kMost> direction;  ///< unit
  std::array<RayHit, kMost> hit;
};

/// Nearest surfaces for light inside `object` from one point along all directions of the fan.
void traceInside(const RayScene& rays, int object, const glm::vec3& from, RayFan& fan);

/// Sight lines that are tested together.
struct SightFan {
  int count = 0;
  std::array<glm::vec3, RayFan::kMost> from, direction;
  std::array<float, RayFan::kMost> distance;
  std::array<bool, RayFan::kMost> blocked;
};
void traceSight(const RayScene& rays, SightFan& fan);

}  // namespace lychnite
