#pragma once

#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

/// Signed distances (negative inside) and ways to blend them, after Inigo Quilez, "Distance functions" and
/// "Smooth minimum" (iquilezles.org/articles/distfunctions, /articles/smin). Where one is only a bound it
/// says so.
namespace lychnite::builtin {

using Field = std::function<double(const glm::dvec3&)>;

/// The quadratic smooth minimum: differs from min(a, b) only where |a - b| < k, by k/4 at most.
inline double smoothUnion(double a, double b, double k) {
  const double h = glm::max(k - glm::abs(a - b), 0.0) / k;
  return glm::min(a, b) - 0.25 * h * h * k;
}
inline double smoothIntersection(double a, double b, double k) {
  return -smoothUnion(-a, -b, k);
}
inline double smoothDifference(double a, double b, double k) {
  return -smoothUnion(-a, b, k);
}

inline double sphere(const glm::dvec3& p, const glm::dvec3& centre, double radius) {
  return glm::length(p - centre) - radius;
}

/// A bound, good near the surface.
inline double ellipsoid(const glm::dvec3& p, const glm::dvec3& centre, const glm::dvec3& radii) {
  const glm::dvec3 q = (p - centre) / radii;
  const double slope = glm::length(q / radii);
  const double level = glm::length(q);
  return slope > 0 ? level * (level - 1) / slope : -glm::min(radii.x, glm::min(radii.y, radii.z));
}

/// Works for points and segments of the plane and of space alike.
template <class Vec>
double segmentDistance(const Vec& p, const Vec& a, const Vec& b) {
  const Vec pa = p - a, ba = b - a;
  return glm::length(pa - ba * glm::clamp(glm::dot(pa, ba) / glm::dot(ba, ba), 0.0, 1.0));
}

/// A capsule whose radius goes linearly from ra at a to rb at b; a bound, exact when the radii are equal.
double taperedCapsule(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double ra, double rb);

/// A box of the plane about `centre`, its corners rounded within its half extents.
double roundedBox(const glm::dvec2& p, const glm::dvec2& centre, const glm::dvec2& half, double rounding);

/// A closed polygon of the plane, either orientation.
double polygon(const glm::dvec2& p, std::span<const glm::dvec2> corners);

/// The least distance to an open line through the points.
double polyline(const glm::dvec2& p, std::span<const glm::dvec2> points);

/// 1 on the line itself, falling smoothly to 0 at `width`; adding a small multiple to a distance engraves the
/// line.
inline double groove(double distance, double width) {
  const double u = glm::min(glm::abs(distance) / width, 1.0);
  return (1 - u * u) * (1 - u * u);
}

/// `pieces` points between each two neighbours of a Catmull-Rom curve through the points (Catmull & Rom
/// 1974).
std::vector<glm::dvec2> smoothCurve(std::span<const glm::dvec2> points, int pieces, bool closed);

/// Gradient by the four-point tetrahedron stencil; `value` is the field there to second order.
struct FieldSample {
  double value;
  glm::dvec3 gradient;
};
FieldSample sampleField(const Field& field, const glm::dvec3& p);

/// One Newton step towards the zero level along the gradient, no longer than `longest`.
glm::dvec3 steppedToSurface(const Field& field, const glm::dvec3& p, double longest);

}  // namespace lychnite::builtin
