#include "reference/walk_film.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace lychnite {

WalkLens::WalkLens(const RayScene& rays, int width, int height)
    : width_(float(width)), height_(float(height)) {
  const CameraFrame frame = rays.camera(width, height);
  const double pixelsX = width / (2 * frame.tanHalfFovX), pixelsY = height / (2 * frame.tanHalfFovY);
  position_ = glm::vec3(frame.position);
  right_ = glm::vec3(frame.right * pixelsX);
  up_ = glm::vec3(frame.up * pixelsY);
  forward_ = glm::vec3(frame.forward);
  scale_ = float(pixelsX * pixelsY);
}

WalkLens::Seen WalkLens::see(const glm::vec3& point) const {
  Seen seen;
  const glm::vec3 way = point - position_;
  const float depth = glm::dot(way, forward_);
  if (depth <= 0) return seen;
  const float x = 0.5f * width_ + glm::dot(way, right_) / depth;
  const float y = 0.5f * height_ - glm::dot(way, up_) / depth;
  if (!(x >= 0 && y >= 0 && x < width_ && y < height_)) return seen;
  seen.pixel = int64_t(y) * int64_t(width_) + int64_t(x);
  seen.distance = glm::length(way);
  seen.direction = -way / seen.distance;
  seen.importance = scale_ * seen.distance / (depth * depth * depth);
  return seen;
}

double WalkLens::largestImportance() const {
  const double nearest = std::max(0.1, double(glm::length(position_)) - 1);
  return double(scale_) / (nearest * nearest);
}

WalkFilm::WalkFilm(size_t pixels, int layers, double quantum)
    : pixels_(pixels),
      layers_(layers),
      quantum_(quantum),
      perQuantum_(1 / quantum),
      sums_(std::make_unique<std::atomic<int64_t>[]>(pixels * size_t(layers) * 3)) {}

glm::dvec3 WalkFilm::take(size_t pixel, int layer) {
  glm::dvec3 value;
  auto* at = &sums_[(size_t(layer) * pixels_ + pixel) * 3];
  for (int c = 0; c < 3; ++c) value[c] = double(at[c].exchange(0, std::memory_order_relaxed)) * quantum_;
  return value;
}

}  // namespace lychnite
