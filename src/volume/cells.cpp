#include "lychnite/volume/volume.h"

namespace lychnite {

int volumeCells(const Scene& scene) {
  constexpr int kUsual = 64, kMore = 96;
  for (const Object& object : scene.objects) {
    const Coefficients& m = object.material.medium;
    const Rgb reduced = m.sigma_a + (1 - m.g) * m.sigma_s;
    if (!object.material.opaque && object.size * (reduced.x + reduced.y + reduced.z) / 3 > kUsual)
      return kMore;
  }
  return kUsual;
}

}  // namespace lychnite
