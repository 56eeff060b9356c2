#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "image/comparable.h"
#include "lychnite/image/metrics.h"
#include "lychnite/image/tone_map.h"

namespace lychnite {
glm::vec3 errorColour(double share) {
  // Five knots of the "magma" map (S. van der Walt & N. Smith 2015, CC0).
  constexpr std::array<std::array<float, 3>, 5> kKnots = {
      {{0, 0, 4}, {81, 18, 124}, {183, 55, 121}, {252, 137, 97}, {252, 253, 191}}};
  const float place = std::clamp(float(share), 0.f, 1.f) * float(kKnots.size() - 1);
  const size_t below = std::min(size_t(place), kKnots.size() - 2);
  const float part = place - float(below);
  glm::vec3 colour;
  for (size_t c = 0; c < 3; ++c)
    colour[int(c)] = ((1 - part) * kKnots[below][c] + part * kKnots[below + 1][c]) / 255;
  return colour;
}

namespace {

constexpr float kBackground = 0.25f;

}  // namespace

Image errorMap(const Image& a, const Image& b, double full) {
  checkComparable(a, b);
  const std::vector<float> weights = coverageOf(b);
  const double mean = meanColour(b, weights);
  Image map(b.width(), b.height());
  for (size_t i = 0; i < map.pixelCount(); ++i) {
    const glm::vec3 difference = glm::abs(a.rgb(i) - b.rgb(i));
    const double relative = (double(difference.r) + double(difference.g) + double(difference.b)) / 3 / mean;
    const glm::vec3 shown = weights[i] > 0 ? errorColour(relative / full) : glm::vec3(kBackground);
    map.setRgb(i, {linearFromSrgb(shown.r), linearFromSrgb(shown.g), linearFromSrgb(shown.b)});
  }
  return map;
}

}  // namespace lychnite
