#include "technique/multiple/lattice.h"

#include <algorithm>
#include <cmath>

namespace lychnite {

double latticeReferenceSize(const Coefficients& medium) {
  double sum = 0;
  int channels = 0;
  for (int c = 0; c < 3; ++c) {
    if (medium.sigma_tp()[c] <= 0) continue;
    sum += 1 / medium.sigma_tp()[c];
    ++channels;
  }
  return channels > 0 ? 23 * sum / channels : 1;
}

double latticeSlope(const LatticeConstants& constants, const Coefficients& medium, double size) {
  const double k = size / latticeReferenceSize(medium);
  return (constants.C1 - constants.C2 * std::log2(k)) * constants.K;
}

std::array<glm::vec4, 49> makeLattice(double slope, int maxLevel) {
  std::array<glm::vec4, 49> cells;
  for (int i = 0; i < 49; ++i) {
    const int x = i % 7 - 3, y = i / 7 - 3;
    const int level =
        int(std::clamp(std::round(slope * std::sqrt(double(x * x + y * y))), 0.0, double(maxLevel)));
    const float step = std::exp2(float(level));
    cells[size_t(i)] = {step * float(x), step * float(y), float(level), step * step};
  }
  return cells;
}

}  // namespace lychnite
