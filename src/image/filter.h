#pragma once

#include <span>
#include <vector>

namespace lychnite {

/// One channel while it is being filtered, top row first.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;
};

/// Separable convolution with two odd-length kernels, the edge pixels repeated beyond the edge. The kernels
/// are applied as they stand, without mirroring: alongX[0] weighs the pixel to the left.
Plane filter(const Plane& plane, std::span<const float> alongX, std::span<const float> alongY);

/// exp(-x^2 / (2 sigma^2)) at x = -radius..radius, scaled to the sum 1.
std::vector<float> gaussianKernel(double sigma, int radius);

}  // namespace lychnite
