#include "technique/multiple/spiral.h"

namespace lychnite {

double spiralReach(const Profile& profile) {
  const Rgb total = profile.P(0);
  double r = 1e-9;
  for (; r < 1e9; r *= 1.2) {
    const Rgb left = profile.P(r);
    if (left.x <= 1e-3 * total.x && left.y <= 1e-3 * total.y && left.z <= 1e-3 * total.z) break;
  }
  return r;
}

double spiralScale(const Profile& profile) {
  const Rgb core = profile.coreLength(), total = profile.P(0);
  double sum = 0;
  int channels = 0;
  for (int c = 0; c < 3; ++c) {
    if (core[c] <= 0 || total[c] <= 0) continue;
    sum += core[c];
    ++channels;
  }
  return channels > 0 ? sum * 3 / channels : 1;
}

}  // namespace lychnite
