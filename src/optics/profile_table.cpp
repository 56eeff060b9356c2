#include <algorithm>
#include <cassert>
#include <cmath>

#include "lychnite/optics/profile.h"

namespace lychnite {
namespace {

/// Three times the shortest core of the channels that scatter: half of the entries lie within that of the
/// peak, and the rest reaches to infinity.
double tableScale(const Profile& profile, double unit) {
  const Rgb core = profile.coreLength();
  double shortest = 0;
  for (int c = 0; c < 3; ++c)
    if (core[c] > 0 && (shortest == 0 || core[c] < shortest)) shortest = core[c];
  return shortest > 0 ? 3 * shortest / unit : 1;
}

}  // namespace

ProfileTable::ProfileTable(const Profile& profile, double unit, int size)
    : scale_(tableScale(profile, unit)), Rd_(size_t(size)), P_(size_t(size)) {
  assert(size >= 2 && unit > 0);
  for (int i = 0; i < size; ++i) {
    const double u = (i + 0.5) / size;
    const double r = scale_ * u / (1 - u) * unit;
    Rd_[size_t(i)] = glm::vec3(profile.Rd(r) * (unit * unit));
    P_[size_t(i)] = glm::vec3(profile.P(r));
  }
}

glm::vec3 ProfileTable::lookUp(const std::vector<glm::vec3>& table, double r) const {
  const double x = r / (r + scale_) * double(table.size()) - 0.5;
  const double clamped = std::clamp(x, 0.0, double(table.size() - 1));
  const size_t i = std::min(size_t(clamped), table.size() - 2);
  const float t = float(clamped - double(i));
  return table[i] * (1 - t) + table[i + 1] * t;
}

}  // namespace lychnite
