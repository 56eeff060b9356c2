#include "score.h"

#include <algorithm>
#include <cmath>

namespace lychnite::accuracy {

Score scoreOf(const Halves& model, const Halves& truth) {
  double one = 0, quiet = 0, variance = 0, told = 0, sum = 0;
  const size_t points = truth[0].size();
  for (size_t i = 0; i < points; ++i) {
    double deviation = 0;
    for (int c = 0; c < 3; ++c) {
      const double m[] = {double(model[0][i][c]), double(model[1][i][c])};
      const double t[] = {double(truth[0][i][c]), double(truth[1][i][c])};
      const double own = 0.5 * ((m[0] - t[0]) * (m[0] - t[1]) + (m[1] - t[0]) * (m[1] - t[1]));
      one += own;
      quiet += 0.5 * ((m[0] - t[0]) * (m[1] - t[1]) + (m[1] - t[0]) * (m[0] - t[1]));
      // With halves of variance s^2, (t1 - t2)^2 is 2 s^2 on average, its square 12 s^4, and the product's
      // variance s^4 + 2 s^2 times its mean.
      const double noise = (t[0] - t[1]) * (t[0] - t[1]);
      deviation += std::sqrt(std::max(own, 0.0) * noise + noise * noise / 12);
      told += 0.5 * (t[0] + t[1]);
      sum += 0.5 * (m[0] + m[1]);
    }
    variance += deviation * deviation;  // the channels share their photons
  }
  const double count = 3 * double(points), mean = told / count;
  const double rmse = std::sqrt(std::max(one / count, 0.0)), deviation = std::sqrt(variance) / count;
  return {.rmse = rmse / mean,
          .error = deviation > 0 ? deviation / std::max(2 * rmse, std::sqrt(deviation)) / mean : 0,
          .quiet = std::sqrt(std::max(quiet / count, 0.0)) / mean,
          .bias = sum / told - 1};
}

Values means(const Values& values, size_t each) {
  Values result(values.size() / each, glm::vec3(0));
  for (size_t i = 0; i < result.size() * each; ++i) result[i / each] += values[i] / float(each);
  return result;
}

}  // namespace lychnite::accuracy
