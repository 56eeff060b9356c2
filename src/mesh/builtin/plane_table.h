#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <vector>

namespace lychnite::builtin {

/// A function of the plane sampled once and looked up often: a quadratic B-spline over a square grid, which
/// is smooth (C1) and rounds corners at the scale of a cell. Outside its rectangle the value at the border
/// goes on.
class PlaneTable {
 public:
  PlaneTable(const std::function<double(const glm::dvec2&)>& function, const glm::dvec2& min,
             const glm::dvec2& max, double cell);

  double operator()(const glm::dvec2& p) const;

 private:
  glm::dvec2 min_;
  double cell_;
  int width_, height_;
  std::vector<double> values_;
};

}  // namespace lychnite::builtin
