#include "image/filter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace lychnite {
namespace {

Plane filterRows(const Plane& plane, std::span<const float> kernel) {
  const int radius = int(kernel.size() / 2), width = plane.width;
  Plane result{width, plane.height, std::vector<float>(plane.values.size())};
  std::vector<float> padded(size_t(width + 2 * radius));
  for (int y = 0; y < plane.height; ++y) {
    const float* row = plane.values.data() + size_t(y) * size_t(width);
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, width, padded.begin() + radius);
    std::fill_n(padded.begin() + radius + width, radius, row[width - 1]);
    float* out = result.values.data() + size_t(y) * size_t(width);
    for (size_t k = 0; k < kernel.size(); ++k)
      for (int x = 0; x < width; ++x) out[x] += kernel[k] * padded[size_t(x) + k];
  }
  return result;
}

Plane filterColumns(const Plane& plane, std::span<const float> kernel) {
  const int radius = int(kernel.size() / 2), width = plane.width;
  Plane result{width, plane.height, std::vector<float>(plane.values.size())};
  for (int y = 0; y < plane.height; ++y) {
    float* out = result.values.data() + size_t(y) * size_t(width);
    for (int k = 0; k < int(kernel.size()); ++k) {
      const int from = std::clamp(y + k - radius, 0, plane.height - 1);
      const float* row = plane.values.data() + size_t(from) * size_t(width);
      for (int x = 0; x < width; ++x) out[x] += kernel[size_t(k)] * row[x];
    }
  }
  return result;
}

}  // namespace

Plane filter(const Plane& plane, std::span<const float> alongX, std::span<const float> alongY) {
  assert(plane.width > 0 && plane.height > 0 && alongX.size() % 2 == 1 && alongY.size() % 2 == 1);
  return filterColumns(filterRows(plane, alongX), alongY);
}

std::vector<float> gaussianKernel(double sigma, int radius) {
  std::vector<double> weights;
  double sum = 0;
  for (int x = -radius; x <= radius; ++x) sum += weights.emplace_back(std::exp(-x * x / (2 * sigma * sigma)));
  std::vector<float> kernel;
  for (const double weight : weights) kernel.push_back(float(weight / sum));
  return kernel;
}

}  // namespace lychnite
