#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace lychnite::accuracy {

/// How far a model is from the truth, RGB together, relative to the mean of the truth.
struct Score {
  double rmse = 0;   ///< of one picture, with the noise that it has
  double error = 0;  ///< standard error that the truth's noise leaves in it; what it may be where it is 0
  double quiet = 0;  ///< rmse without the model's own noise, where it is told twice
  double bias = 0;   ///< of the mean
};

using Values = std::vector<glm::vec3>;  ///< of points of equal weight
/// One model or truth, told twice, independently.
using Halves = std::array<Values, 2>;

/// Mean square errors without the truth's noise: the mean of (M - T1)(M - T2) over both models, and without
/// the model's too, that of (M1 - T1)(M2 - T2). A model without noise is given twice: then they are the same.
Score scoreOf(const Halves& model, const Halves& truth);

/// Means over `each` neighbours.
Values means(const Values& values, size_t each);

}  // namespace lychnite::accuracy
