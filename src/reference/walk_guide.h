#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "reference/ray_scene.h"
#include "reference/transport.h"

namespace lychnite {

/// What a pilot run saw: for each cell of a coarse grid over the unit sphere, how much a fan of rays from
/// collisions there adds to the picture and to its variance, and where the light leaves.
struct WalkGuideSamples {
  static constexpr int kCells = 32;
  static constexpr float kCellSize = 2.0f / kCells;  ///< scene units
  struct Cell {
    float count = 0;       ///< fans
    float squares = 0;     ///< of their splats, over the square of the fan's reach
    float reaches = 0;     ///< of the fans; see WalkGuide::chance
    float light = 0;       ///< sum of splats
    glm::vec3 towards{0};  ///< sum of splats times direction
    float splats = 0;      ///< how many
  };
  WalkGuideSamples() : cells(size_t(kCells) * kCells * kCells), starts(cells.size()), passing(cells.size()) {}

  static size_t cellOf(const glm::vec3& p) {
    size_t index = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const int i = int((p[axis] + 1) * (0.5f * kCells));
      index = index * kCells + size_t(i < 0 ? 0 : i >= kCells ? kCells - 1 : i);
    }
    return index;
  }
  void merge(const WalkGuideSamples& other);

  /// Of the photons that start in a cell: how many, their splats squared, and their cost in fans.
  struct Start {
    float count = 0, squares = 0, cost = 0;
  };
  /// How often photons should start in a cell against their share of the power, for the least variance times
  /// cost. About 1 on average and nowhere near 0.
  std::vector<float> startImportance() const;
  /// How heavy a photon should be in each cell, over what it carries on average at the start, so that it goes
  /// on alone: 1 / root of (what it will add to the variance, over its weight squared, per cost).
  std::vector<float> idealWeights() const;

  std::vector<Cell> cells;
  std::vector<Start> starts;
  std::vector<Start>
      passing;  ///< the same of photons that collide in a cell, from there on, for a unit of weight
  double commonSquares = 0;  ///< what photons add to the variance that more fans would not lessen
};

/// Decides how many fans of rays a collision sends towards the surface, and where: in proportion to the root
/// of their second moment (the optimal roulette and splitting: variance times cost is least), partly along a
/// lobe (von Mises-Fisher) towards where light that the camera sees leaves. All learnt by a pilot; whatever
/// it holds, the picture is unbiased, because fans are weighted by one over their expected number and rays by
/// their density.
class WalkGuide {
 public:
  struct Lobe {
    glm::vec3 mean{0, 0, 1};
    float kappa = 0;  ///< 0: nothing known

    glm::vec3 draw(float u, float phi) const;
    float density(const glm::vec3& direction) const;  ///< 1/sr
  };

  /// Nothing learnt: fans everywhere with this chance, for the pilot.
  explicit WalkGuide(float chance) : places_(1) { places_.front().chance = chance; }
  /// `work` is the pilot's cost without fans over the cost of one fan, per photon, `photons` those of the
  /// pilot.
  WalkGuide(const WalkGuideSamples& samples, double photons, double work);

  /// idealWeights() of p's cell; 0 where nothing is known.
  float idealWeight(const glm::vec3& p) const {
    return ideal_.empty() ? 0 : ideal_[WalkGuideSamples::cellOf(p)];
  }

  /// How many fans a collision at p sends on average. `reach` is the most that a splat of it could carry,
  /// over what the photon started with.
  float fans(const glm::vec3& p, float reach) const {
    return std::fmin(std::fmax(place(p).chance, kLeast) * reach, kMost);
  }
  const Lobe& lobe(const glm::vec3& p) const { return place(p).lobe; }

 private:
  static constexpr float kLeast = 0.01f, kMost = 8;
  struct Place {
    float chance = 0;
    Lobe lobe;
  };
  const Place& place(const glm::vec3& p) const {
    return places_.size() == 1 ? places_.front() : places_[WalkGuideSamples::cellOf(p)];
  }
  std::vector<Place> places_;
  std::vector<float> ideal_;
};

}  // namespace lychnite
