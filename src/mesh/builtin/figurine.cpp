// A chess knight: a turned base, and above it a carved horse's head, looking towards -x.
//
// The head is made as a carver makes it: sawn out along its profile, cut down to the breadth it has from the
// front, then rounded; mane, ears, eyes and lines follow.

#include <algorithm>
#include <vector>

#include "mesh/builtin/models.h"
#include "mesh/builtin/plane_table.h"
#include "mesh/builtin/portable_trig.h"
#include "mesh/builtin/relax.h"

namespace lychnite::builtin {
namespace {

using glm::dvec2;
using glm::dvec3;

/// The head's half breadth at places of the profile, chosen by eye; between them it is blended.
struct Breadth {
  dvec2 at;
  double half;
};
constexpr Breadth kBreadths[] = {{{-0.12, 0.24}, 0.170}, {{0.04, 0.23}, 0.176},  {{0.15, 0.24}, 0.170},
                                 {{-0.10, 0.40}, 0.140}, {{0.04, 0.41}, 0.138},  {{0.16, 0.41}, 0.110},
                                 {{-0.03, 0.54}, 0.112}, {{0.10, 0.54}, 0.098},  {{0.04, 0.64}, 0.105},
                                 {{0.15, 0.65}, 0.065},  {{-0.06, 0.70}, 0.108}, {{-0.03, 0.86}, 0.085},
                                 {{0.10, 0.83}, 0.060},  {{-0.14, 0.79}, 0.098}, {{-0.22, 0.70}, 0.070},
                                 {{-0.29, 0.62}, 0.066}, {{-0.22, 0.56}, 0.054}};

double halfBreadth(const dvec2& p) {
  double sum = 0, weights = 0;
  for (const Breadth& b : kBreadths) {
    const double d2 = glm::dot(p - b.at, p - b.at) + 5e-3;
    sum += b.half / (d2 * d2);
    weights += 1 / (d2 * d2);
  }
  return sum / weights;
}

constexpr dvec2 kOutline[] = {
    {-0.172, 0.05},  {-0.172, 0.20},  {-0.180, 0.27},  {-0.186, 0.34},  {-0.172, 0.41},  {-0.143, 0.475},
    {-0.112, 0.535}, {-0.105, 0.578}, {-0.14, 0.588},  {-0.19, 0.562},  {-0.245, 0.537}, {-0.29, 0.540},
    {-0.318, 0.57},  {-0.333, 0.615}, {-0.322, 0.658}, {-0.285, 0.703}, {-0.235, 0.757}, {-0.19, 0.82},
    {-0.145, 0.872}, {-0.09, 0.90},   {-0.02, 0.905},  {0.05, 0.885},   {0.115, 0.835},  {0.16, 0.76},
    {0.185, 0.67},   {0.192, 0.57},   {0.188, 0.46},   {0.18, 0.34},    {0.175, 0.20},   {0.175, 0.05}};

constexpr dvec2 kCrest[] = {{-0.03, 0.905}, {0.035, 0.89}, {0.095, 0.853}, {0.14, 0.80},   {0.172, 0.725},
                            {0.188, 0.645}, {0.192, 0.56}, {0.190, 0.475}, {0.185, 0.395}, {0.18, 0.33}};

/// The mane's locks along the crest: its outline in the profile's plane, and the lines carved between the
/// locks.
struct Mane {
  std::vector<dvec2> outline;
  std::vector<std::vector<dvec2>> lines;
};

Mane combedMane() {
  Mane mane;
  std::vector<dvec2> outer, inner;
  for (size_t i = 0; i + 1 < std::size(kCrest); ++i) {
    const dvec2 a = kCrest[i], along = kCrest[i + 1] - a;
    const dvec2 out = glm::normalize(dvec2(-along.y, along.x));
    // A lock leaves its notch, swells, and ends in a tip that points down.
    outer.insert(outer.end(),
                 {a + 0.004 * out, a + 0.33 * along + 0.032 * out, a + 0.70 * along + 0.046 * out,
                  a + 0.95 * along + 0.040 * out, a + 0.98 * along + 0.018 * out});
    inner.push_back(a - 0.10 * out);
    const dvec2 notch[] = {a + 0.02 * out, a - 0.02 * out - 0.1 * along, a - 0.055 * out - 0.5 * along,
                           a - 0.085 * out - 1.1 * along};
    if (i > 0) mane.lines.push_back(smoothCurve(notch, 4, false));
  }
  mane.outline = smoothCurve(outer, 3, false);
  const std::vector<dvec2> back = smoothCurve(inner, 2, false);
  mane.outline.insert(mane.outline.end(), back.rbegin(), back.rend());
  return mane;
}

double smoothStep(double from, double to, double x) {
  const double t = glm::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

class Knight {
 public:
  double operator()(const dvec3& p) const {
    const double base = p.y < 0.36 ? baseAt(p) : p.y - 0.30;
    if (p.y < 0.17) return base;
    return smoothUnion(base, glm::max(headAt({p.x, p.y, glm::abs(p.z)}), 0.205 - p.y), 0.02);
  }

 private:
  static PlaneTable table(const std::function<double(const dvec2&)>& function) {
    return PlaneTable(function, {-0.42, 0.1}, {0.36, 1.1}, 0.004);
  }

  /// Turned on a lathe: foot, bead, hollow flank, collar.
  static double baseAt(const dvec3& p) {
    const dvec2 q(std::sqrt(p.x * p.x + p.z * p.z), p.y);
    double d = roundedBox(q, {0, 0.034}, {0.272, 0.034}, 0.024);
    d = smoothUnion(d, roundedBox(q, {0, 0.083}, {0.243, 0.02}, 0.0195), 0.024);
    const double flank = glm::dot(q - dvec2(0.225, 0.105), dvec2(0.85, 0.526));
    const double hollow = 0.16 - glm::length(q - dvec2(0.332, 0.222));
    const double body = glm::max(glm::max(flank, hollow), roundedBox(q, {0, 0.15}, {0.26, 0.065}, 0.01));
    d = smoothUnion(d, body, 0.016);
    return smoothUnion(d, roundedBox(q, {0, 0.213}, {0.209, 0.015}, 0.0145), 0.026);
  }

  /// p.z is at least 0: both sides are alike.
  double headAt(const dvec3& p) const {
    const dvec2 side(p.x, p.y);
    const double rounding = glm::mix(0.17, 0.085, smoothStep(0.3, 0.6, p.y));
    double d = smoothIntersection(profile_(side), p.z - breadth_(side), rounding);
    if (d > 0.16) return d - 0.06;  // clear of everything below
    d = smoothUnion(d, ellipsoid(p, {-0.055, 0.672, 0.07}, {0.085, 0.09, 0.050}), 0.04);  // jaw
    d = faceAt(p, d);
    d = maneAt(p, d);
    return smoothUnion(d, earAt(p), 0.02);
  }

  double faceAt(const dvec3& p, double d) const {
    if (p.x > 0) return d;
    const dvec3 brow[] = {{-0.195, 0.804, 0.052}, {-0.105, 0.822, 0.080}};
    d = smoothUnion(d, taperedCapsule(p, {-0.13, 0.725, 0.082}, {-0.23, 0.665, 0.058}, 0.012, 0.008), 0.03);
    d = smoothUnion(d, ellipsoid(p, {-0.298, 0.632, 0.05}, {0.032, 0.030, 0.028}), 0.02);
    d = smoothDifference(d, ellipsoid(p, {-0.308, 0.634, 0.082}, {0.017, 0.012, 0.02}), 0.01);
    d = smoothUnion(d, taperedCapsule(p, brow[0], brow[1], 0.012, 0.018), 0.02);
    d = smoothDifference(d, ellipsoid(p, {-0.155, 0.778, 0.104}, {0.032, 0.022, 0.022}), 0.012);
    d = smoothUnion(d, ellipsoid(p, {-0.153, 0.779, 0.082}, {0.024, 0.017, 0.019}), 0.004);
    return d + 0.009 * groove(mouth_({p.x, p.y}), 0.014);
  }

  double maneAt(const dvec3& p, double d) const {
    const dvec2 side(p.x, p.y);
    const double region = mane_(side);
    if (region > 0.08) return d;
    const double grown = smoothStep(0, 0.045, -region);
    d -= 0.011 * grown;
    d = smoothUnion(d, smoothIntersection(p.z - 0.026, region, 0.024), 0.02);
    return d + 0.011 * grown * groove(lines_(side), 0.014);
  }

  static double earAt(const dvec3& p) {
    const dvec3 root(-0.060, 0.88, 0.046), middle(-0.075, 0.940, 0.058), tip(-0.086, 1.035, 0.066);
    const double leaf = smoothUnion(taperedCapsule(p, root, middle, 0.033, 0.0335),
                                    taperedCapsule(p, middle, tip, 0.0335, 0.006), 0.012);
    return smoothDifference(leaf, ellipsoid(p, {-0.110, 0.956, 0.080}, {0.024, 0.052, 0.021}), 0.012);
  }

  Mane combed_ = combedMane();
  PlaneTable profile_ =
      table([curve = smoothCurve(kOutline, 3, true)](const dvec2& p) { return polygon(p, curve); });
  PlaneTable breadth_ = table(halfBreadth);
  PlaneTable mane_ = table([this](const dvec2& p) { return polygon(p, combed_.outline); });
  PlaneTable lines_ = table([this](const dvec2& p) {
    double nearest = 1;
    for (const auto& line : combed_.lines) nearest = glm::min(nearest, polyline(p, line));
    return nearest;
  });
  PlaneTable mouth_ = table([](const dvec2& p) {
    static constexpr dvec2 kMouth[] = {{-0.36, 0.578}, {-0.28, 0.588}, {-0.24, 0.598}, {-0.212, 0.615}};
    return polyline(p, kMouth);
  });
};

}  // namespace

Mesh makeFigurine() {
  const Knight knight;
  const Field field = [&](const dvec3& p) { return knight(p); };
  Surface s = surfaceOf(field, {.bounds = {{-0.4, -0.03, -0.32}, {0.32, 1.06, 0.32}},
                                .cell = 0.0061,
                                .triangles = 31398,
                                .evenness = 3e-4,
                                .relax_rounds = 3});
  // Turned a little towards +z, where the camera is.
  const CirclePoint turn = circlePoint(0.07);
  for (dvec3& p : s.positions) p = {turn.cos * p.x + turn.sin * p.z, p.y, turn.cos * p.z - turn.sin * p.x};
  return finishMesh(s);
}

}  // namespace lychnite::builtin
