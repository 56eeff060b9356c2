// A half-melted candle: a hollow of molten wax under a bent wick, a rim that has given way, runs down the
// side, and what ran off in a flat cake around the foot.

#include <vector>

#include "mesh/builtin/models.h"
#include "mesh/builtin/portable_trig.h"
#include "mesh/builtin/relax.h"

namespace lychnite::builtin {
namespace {

using glm::dvec3;

constexpr double kRadius = 0.155, kTop = 0.80;

/// Wax that ran down the side and stopped in a drop, or reached the foot.
struct Run {
  double turns;     ///< where around the candle, in full turns from +x towards +z
  double from, to;  ///< heights
  double drift;     ///< how far around it wandered on its way, in turns
  double width;     ///< radius of the run
  double drop;      ///< radius of the drop at its end
};
constexpr Run kRuns[] = {{0.02, 0.79, 0.30, 0.012, 0.017, 0.030},  {0.10, 0.78, 0.52, -0.010, 0.014, 0.024},
                         {0.18, 0.76, 0.05, 0.016, 0.021, 0.034},  {0.245, 0.75, 0.42, 0.006, 0.018, 0.033},
                         {0.33, 0.78, 0.61, 0.008, 0.013, 0.022},  {0.40, 0.80, 0.22, -0.014, 0.018, 0.031},
                         {0.50, 0.80, 0.56, 0.010, 0.014, 0.025},  {0.58, 0.79, 0.05, 0.012, 0.019, 0.032},
                         {0.67, 0.80, 0.45, -0.012, 0.016, 0.028}, {0.76, 0.80, 0.64, 0.006, 0.013, 0.022},
                         {0.83, 0.79, 0.16, 0.014, 0.018, 0.031},  {0.92, 0.80, 0.50, 0.008, 0.015, 0.026}};

dvec3 onSide(double turns, double height, double radius) {
  const CirclePoint c = circlePoint(turns);
  return {radius * c.cos, height, radius * c.sin};
}

class Candle {
 public:
  Candle() {
    for (const Run& run : kRuns) {
      // Over the rim, down with a slight bend, and out a little where the drop hangs.
      const double middle = 0.45 * run.from + 0.55 * run.to;
      lines_.push_back(
          {run,
           {onSide(run.turns, run.from + 0.005, kRadius - 0.03), onSide(run.turns, run.from - 0.03, kRadius),
            onSide(run.turns + 0.7 * run.drift, middle, kRadius + 0.001),
            onSide(run.turns + 0.6 * run.drift, run.to, kRadius + 0.004)}});
    }
  }

  double operator()(const dvec3& p) const {
    double d = smoothUnion(bodyAt(p), footAt(p), 0.05);
    for (const Line& line : lines_) d = smoothUnion(d, runAt(p, line), 0.022);
    d = smoothDifference(d, hollowAt(p), 0.03);
    return smoothUnion(d, wickAt(p), 0.018);
  }

 private:
  struct Line {
    Run run;
    dvec3 at[4];
  };

  static double bodyAt(const dvec3& p) {
    const double across = std::sqrt(p.x * p.x + p.z * p.z);
    const double swell = 0.012 * smoothBump((p.y - 0.2) / 0.3);
    return roundedBox({across, p.y}, {0, 0.4}, {kRadius + swell, 0.4}, 0.03);
  }

  static double smoothBump(double u) { return glm::abs(u) < 1 ? (1 - u * u) * (1 - u * u) : 0; }

  /// The cake of cold wax, with lobes where runs arrived.
  static double footAt(const dvec3& p) {
    double d = ellipsoid(p, {0, 0.01, 0}, {0.275, 0.055, 0.265});
    d = smoothUnion(d, ellipsoid(p, {0.13, 0.01, 0.20}, {0.13, 0.042, 0.10}), 0.05);
    d = smoothUnion(d, ellipsoid(p, {-0.21, 0.01, -0.12}, {0.12, 0.04, 0.11}), 0.05);
    d = smoothUnion(d, ellipsoid(p, {-0.15, 0.01, 0.19}, {0.10, 0.035, 0.08}), 0.05);
    d = smoothUnion(d, ellipsoid(p, {0.20, 0.01, -0.14}, {0.11, 0.035, 0.10}), 0.05);
    return smoothIntersection(d, -p.y, 0.02);
  }

  static double runAt(const dvec3& p, const Line& line) {
    const double w = line.run.width;
    double d = taperedCapsule(p, line.at[0], line.at[1], 0.9 * w, w);
    d = smoothUnion(d, taperedCapsule(p, line.at[1], line.at[2], w, 0.8 * w), 0.01);
    d = smoothUnion(d, taperedCapsule(p, line.at[2], line.at[3], 0.8 * w, 0.9 * w), 0.01);
    const double r = line.run.drop;
    return smoothUnion(d, ellipsoid(p, line.at[3], {0.85 * r, 1.25 * r, 0.85 * r}), 0.03);
  }

  /// The molten bowl, and the place where its rim has sunk and the widest runs left.
  static double hollowAt(const dvec3& p) {
    const double bowl = ellipsoid(p, {0, 0.83, 0}, {0.128, 0.10, 0.128});
    const double breach = ellipsoid(p, {0.04, 0.86, 0.15}, {0.085, 0.115, 0.09});
    return smoothUnion(bowl, breach, 0.04);
  }

  static double wickAt(const dvec3& p) {
    const dvec3 bend(0.006, 0.83, 0.002), tip(0.034, 0.895, 0.010);
    double d = taperedCapsule(p, {0, 0.70, 0}, bend, 0.013, 0.0115);
    d = smoothUnion(d, taperedCapsule(p, bend, tip, 0.0115, 0.010), 0.01);
    return smoothUnion(d, sphere(p, tip, 0.013), 0.01);
  }

  std::vector<Line> lines_;
};

}  // namespace

Mesh makeCandle() {
  const Candle candle;
  const Field field = [&](const dvec3& p) { return candle(p); };
  return finishMesh(surfaceOf(field, {.bounds = {{-0.4, -0.04, -0.36}, {0.4, 0.96, 0.38}},
                                      .cell = 0.0095,
                                      .triangles = 12136,
                                      .evenness = 4e-4,
                                      .relax_rounds = 3}));
}

}  // namespace lychnite::builtin
