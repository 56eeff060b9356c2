#pragma once

#include <vector>

namespace lychnite {

/// Values at even steps, smoothed: the s that minimises the sum of weight (value - s)^2 + roughness (third
/// differences of s)^2 (Whittaker 1923), with a touch of first differences so that steps of no weight go on
/// level.
std::vector<double> whittakerSmoothed(const std::vector<double>& values, const std::vector<double>& weights,
                                      double roughness);

/// Catmull-Rom curve through values at 0, 1, 2...; level outside. `derivative` is by x.
struct CurvePoint {
  double value = 0, derivative = 0;
};
CurvePoint curveAt(const std::vector<double>& values, double x);

}  // namespace lychnite
