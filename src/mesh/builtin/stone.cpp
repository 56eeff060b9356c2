#include <algorithm>
#include <array>

#include "mesh/builtin/models.h"
#include "mesh/builtin/relax.h"

namespace lychnite::builtin {
namespace {

/// A flat cut across the stone: what lies beyond `reach` along the direction is gone.
struct Cut {
  glm::dvec3 direction;
  double reach;
};

/// Chosen by eye: a broad flat foot, a sloping top and a few large breaks, with small ones between them.
const std::array<Cut, 19>& cuts() {
  static const std::array<Cut, 19> all = [] {
    std::array<Cut, 19> list{{{{0, -1, 0.05}, 0.27},
                              {{0.15, 1, 0.1}, 0.31},
                              {{-0.55, 0.8, 0.25}, 0.33},
                              {{0.7, 0.65, -0.2}, 0.34},
                              {{0.1, 0.55, 0.85}, 0.33},
                              {{-0.1, 0.45, -0.9}, 0.34},
                              {{0.95, 0.05, 0.35}, 0.43},
                              {{-1, 0.1, 0.2}, 0.44},
                              {{0.5, -0.1, 0.9}, 0.38},
                              {{-0.55, -0.05, 0.85}, 0.39},
                              {{0.6, 0.05, -0.8}, 0.39},
                              {{-0.6, 0.1, -0.8}, 0.385},
                              {{0.8, -0.6, 0.1}, 0.40},
                              {{-0.75, -0.65, 0.2}, 0.39},
                              {{0.1, -0.7, 0.75}, 0.345},
                              {{0, -0.7, -0.75}, 0.35},
                              {{0.75, 0.5, 0.6}, 0.385},
                              {{-0.8, 0.45, -0.45}, 0.41},
                              {{-0.35, 0.65, 0.7}, 0.355}}};
    for (Cut& cut : list) cut.direction = glm::normalize(cut.direction);
    return list;
  }();
  return all;
}

double stoneField(const glm::dvec3& p) {
  constexpr double kEdge = 0.022;
  double d = ellipsoid(p, glm::dvec3(0), {0.52, 0.4, 0.46});
  for (const Cut& cut : cuts()) d = smoothIntersection(d, glm::dot(p, cut.direction) - cut.reach, kEdge);
  return d;
}

}  // namespace

Mesh makeStone() {
  const glm::dvec3 half(0.6);
  return finishMesh(surfaceOf(
      stoneField,
      {.bounds = {-half, half}, .cell = 0.04, .triangles = 1114, .evenness = 5e-3, .relax_rounds = 3}));
}

}  // namespace lychnite::builtin
