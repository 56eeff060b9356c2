#pragma once

#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>

#include "reference/ray_scene.h"

namespace lychnite {

/// The camera as the place where light arrives.
class WalkLens {
 public:
  WalkLens(const RayScene& rays, int width, int height);

  /// How the camera sees a point: its pixel, and what a flux there adds to the pixel's mean radiance (box
  /// filter) per unit of (radiance shape times cosine). pixel < 0 outside the picture.
  struct Seen {
    int64_t pixel = -1;
    glm::vec3 direction{0};  ///< unit, towards the camera
    float distance = 0;
    float importance = 0;  ///< 1 / (area that the pixel covers at the point, across the view)
  };
  Seen see(const glm::vec3& point) const;

  /// Largest plausible importance: at the near end of the scene's unit sphere, or a tenth of a unit off the
  /// camera.
  double largestImportance() const;

 private:
  glm::vec3 position_, right_, up_, forward_;  ///< right and up scaled to pixels at unit depth
  float width_, height_, scale_;
};

/// Sums of splats, in fixed point: whole numbers add up the same in any order, so the picture does not depend
/// on the threads. Layer 0 is the radiance of orders two and up; layer 1, when there, the radiosity of all
/// orders.
class WalkFilm {
 public:
  WalkFilm(size_t pixels, int layers, double quantum);

  void add(int64_t pixel, int layer, const glm::vec3& value) {
    auto* at = &sums_[size_t((layer * int64_t(pixels_) + pixel) * 3)];
    for (int c = 0; c < 3; ++c)
      at[c].fetch_add(int64_t(double(value[c]) * perQuantum_), std::memory_order_relaxed);
  }
  /// The sum so far, back to 0.
  glm::dvec3 take(size_t pixel, int layer);
  int layers() const { return layers_; }
  size_t pixels() const { return pixels_; }

 private:
  size_t pixels_;
  int layers_;
  double quantum_, perQuantum_;
  std::unique_ptr<std::atomic<int64_t>[]> sums_;
};

}  // namespace lychnite
