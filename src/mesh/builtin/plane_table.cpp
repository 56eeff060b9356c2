#include "mesh/builtin/plane_table.h"

#include <cmath>
#include <glm/common.hpp>

namespace lychnite::builtin {

PlaneTable::PlaneTable(const std::function<double(const glm::dvec2&)>& function, const glm::dvec2& min,
                       const glm::dvec2& max, double cell)
    : min_(min),
      cell_(cell),
      width_(static_cast<int>(std::ceil((max.x - min.x) / cell)) + 1),
      height_(static_cast<int>(std::ceil((max.y - min.y) / cell)) + 1) {
  values_.reserve(size_t(width_) * height_);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) values_.push_back(function(min + cell * glm::dvec2(x, y)));
}

double PlaneTable::operator()(const glm::dvec2& p) const {
  const glm::dvec2 last(width_ - 2, height_ - 2);
  const glm::dvec2 at = glm::clamp((p - min_) / cell_, glm::dvec2(1), last);
  const int x = static_cast<int>(at.x + 0.5), y = static_cast<int>(at.y + 0.5);
  const auto weights = [](double t, double w[3]) {
    w[0] = 0.5 * (0.5 - t) * (0.5 - t);
    w[1] = 0.75 - t * t;
    w[2] = 0.5 * (0.5 + t) * (0.5 + t);
  };
  double wx[3], wy[3], sum = 0;
  weights(at.x - x, wx);
  weights(at.y - y, wy);
  for (int j = 0; j < 3; ++j) {
    const double* row = &values_[size_t(y + j - 1) * width_ + x - 1];
    sum += wy[j] * (wx[0] * row[0] + wx[1] * row[1] + wx[2] * row[2]);
  }
  return sum;
}

}  // namespace lychnite::builtin
