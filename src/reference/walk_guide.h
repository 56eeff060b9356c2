#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "reference/ray_scene.h"

namespace lychnite {

/// What a pilot run saw: for each cell of a coarse grid over the unit sphere, how much a fan of rays from
/// collisions there adds to the picture's variance.
struct WalkGuideSamples {
  static constexpr int kCells = 32;
  WalkGuideSamples() : count(size_t(kCells) * kCells * kCells), squares(count.size()) {}

  static size_t cellOf(const glm::vec3& p) {
    size_t index = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const int i = int((p[axis] + 1) * (0.5f * kCells));
      index = index * kCells + size_t(i < 0 ? 0 : i >= kCells ? kCells - 1 : i);
    }
    return index;
  }
  /// A fan from p by a photon of weight 1 (brightest channel) added `square`, the sum of its splats squared;
  /// it stands for 1/chance fans.
  void add(const glm::vec3& p, float square, float chance) {
    const size_t cell = cellOf(p);
    count[cell] += 1 / chance;
    squares[cell] += square / chance;
  }
  void merge(const WalkGuideSamples& other);

  std::vector<float> count, squares;
};

/// Decides at which collisions a fan of rays towards the surface pays: with a chance in proportion to the
/// root of its second moment (the optimal roulette: variance times cost is least), learnt by a pilot.
/// Whatever it holds, the picture is unbiased, because every fan is weighted by one over its chance.
class WalkGuide {
 public:
  /// The same chance everywhere, for the pilot.
  explicit WalkGuide(float chance) : chance_(size_t(1), chance) {}
  /// Learnt; `work` is the pilot's cost without fans over the cost of one fan, per photon, `photons` of the
  /// pilot.
  WalkGuide(const WalkGuideSamples& samples, double photons, double work);

  /// Chance of a fan at p for a photon that carries `weight` of what it started with (brightest channel).
  float chance(const glm::vec3& p, float weight) const {
    if (chance_.size() == 1) return chance_.front();
    const float c = weight * chance_[WalkGuideSamples::cellOf(p)];
    return c < kLeast ? kLeast : c > 1 ? 1.0f : c;
  }

 private:
  static constexpr float kLeast = 0.01f;
  std::vector<float> chance_;
};

}  // namespace lychnite
