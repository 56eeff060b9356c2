#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "reference/ray_scene.h"

namespace lychnite {

/// How far light inside an object can surely fly before it meets a surface: a grid of lower bounds on the
/// distance to the nearest surface that RayScene::nearestInside sees. Most flights in a big object end within
/// it and need no ray.
class WalkDistance {
 public:
  /// `cells` along the object's longest side.
  WalkDistance(const RayScene& rays, int object, int cells);

  /// Whether a point is in the object's bounding box (widened by a cell).
  bool contains(const glm::vec3& p) const {
    const glm::vec3 q = (p - min_) * perCell_;
    return q.x >= 0 && q.y >= 0 && q.z >= 0 && q.x < float(size_.x) && q.y < float(size_.y) &&
           q.z < float(size_.z);
  }
  /// How far the way from p along unit `direction` is surely clear, looked for up to `wanted`: sphere after
  /// sphere.
  /// `first` is what is known to be clear about p.
  float along(const glm::vec3& p, const glm::vec3& direction, float wanted, float first) const {
    float clear = first;
    if (first <= 0.25f * cell_) return first;
    for (int step = 1; step < kSteps && clear < wanted; ++step) {
      const float more = at(p + clear * direction);
      if (more <= 0.25f * cell_) break;
      clear += more;
    }
    return clear;
  }
  /// Lower bound at a point, scene units; 0 outside the grid and close to a surface.
  float at(const glm::vec3& p) const {
    const glm::vec3 q = (p - min_) * perCell_;
    if (q.x < 0 || q.y < 0 || q.z < 0) return 0;
    const auto i = uint32_t(q.x), j = uint32_t(q.y), k = uint32_t(q.z);
    if (i >= size_.x || j >= size_.y || k >= size_.z) return 0;
    const glm::vec3 off = q - glm::vec3(float(i) + 0.5f, float(j) + 0.5f, float(k) + 0.5f);
    const auto bound = float(bound_[(size_t(k) * size_.y + j) * size_.x + i]);
    return cell_ * (bound / kPerCell - std::sqrt(glm::dot(off, off)));
  }

 private:
  static constexpr int kSteps = 8;
  static constexpr float kPerCell =
      4;  ///< stored steps per cell: one byte each, so that the grid stays in the cache
  std::vector<uint8_t> touchedCells(const RayScene& rays, int object) const;

  glm::vec3 min_{0};
  float cell_ = 1, perCell_ = 1;
  glm::uvec3 size_{1};
  std::vector<uint8_t> bound_;  ///< for the cell's centre, rounded down
};

}  // namespace lychnite
