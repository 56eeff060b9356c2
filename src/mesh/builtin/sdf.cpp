#include "mesh/builtin/sdf.h"

#include <vector>

namespace lychnite::builtin {

double taperedCapsule(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double ra, double rb) {
  const glm::dvec3 pa = p - a, ba = b - a;
  const double along = glm::clamp(glm::dot(pa, ba) / glm::dot(ba, ba), 0.0, 1.0);
  return glm::length(pa - along * ba) - glm::mix(ra, rb, along);
}

double roundedBox(const glm::dvec2& p, const glm::dvec2& centre, const glm::dvec2& half, double rounding) {
  const glm::dvec2 q = glm::abs(p - centre) - half + rounding;
  return glm::length(glm::max(q, 0.0)) + glm::min(glm::max(q.x, q.y), 0.0) - rounding;
}

double polygon(const glm::dvec2& p, std::span<const glm::dvec2> corners) {
  double nearest = 1e30;
  bool inside = false;
  for (size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const glm::dvec2 a = corners[j], side = corners[i] - a, pa = p - a;
    const glm::dvec2 off = pa - side * glm::clamp(glm::dot(pa, side) / glm::dot(side, side), 0.0, 1.0);
    nearest = glm::min(nearest, glm::dot(off, off));
    const bool crosses = (corners[i].y > p.y) != (a.y > p.y);
    if (crosses && pa.x < side.x * pa.y / side.y) inside = !inside;
  }
  return inside ? -std::sqrt(nearest) : std::sqrt(nearest);
}

double polyline(const glm::dvec2& p, std::span<const glm::dvec2> points) {
  double nearest = 1e30;
  for (size_t i = 1; i < points.size(); ++i)
    nearest = glm::min(nearest, segmentDistance(p, points[i - 1], points[i]));
  return nearest;
}

std::vector<glm::dvec2> smoothCurve(std::span<const glm::dvec2> points, int pieces, bool closed) {
  const int n = static_cast<int>(points.size());
  const auto at = [&](int i) { return points[closed ? (i + n) % n : glm::clamp(i, 0, n - 1)]; };
  std::vector<glm::dvec2> curve;
  for (int i = 0; i < (closed ? n : n - 1); ++i) {
    const glm::dvec2 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
    for (int k = 0; k < pieces; ++k) {
      const double t = double(k) / pieces;
      curve.push_back(0.5 * (2.0 * b + t * ((c - a) + t * ((2.0 * a - 5.0 * b + 4.0 * c - d) +
                                                           t * (3.0 * (b - c) + d - a)))));
    }
  }
  if (!closed) curve.push_back(points.back());
  return curve;
}

FieldSample sampleField(const Field& field, const glm::dvec3& p) {
  constexpr double kStep = 5e-4;
  static const glm::dvec3 kCorners[] = {{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}};
  FieldSample sample{0, glm::dvec3(0)};
  for (const glm::dvec3& corner : kCorners) {
    const double value = field(p + kStep * corner);
    sample.value += 0.25 * value;
    sample.gradient += value * corner / (4 * kStep);
  }
  return sample;
}

glm::dvec3 steppedToSurface(const Field& field, const glm::dvec3& p, double longest) {
  const FieldSample s = sampleField(field, p);
  const double slope2 = glm::max(glm::dot(s.gradient, s.gradient), 1e-4);
  glm::dvec3 step = -s.value * s.gradient / slope2;
  const double length = glm::length(step);
  if (length > longest) step *= longest / length;
  return p + step;
}

}  // namespace lychnite::builtin
