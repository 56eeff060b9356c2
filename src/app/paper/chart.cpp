#include "app/paper/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/paper/canvas.h"
#include "lychnite/base/atomic_file.h"

namespace lychnite::paper {
namespace {

constexpr double kWidth = 460, kHeight = 345;
constexpr glm::dvec2 kFrom{62, 34}, kSize{378, 240};  // of the frame
constexpr double kText = 11.5;
constexpr float kGrid = 0.87f, kMinorGrid = 0.945f;

struct Look {
  glm::vec3 colour;  // dark ones of Okabe and Ito's set, which colour-blind people tell apart
  std::vector<double> dashes;
  Marker marker;
};

const Look& lookOf(int style) {
  static const std::array<Look, 6> kLooks{{{{0.00f, 0.00f, 0.00f}, {}, Marker::kCircle},
                                           {{0.84f, 0.37f, 0.00f}, {7, 3}, Marker::kSquare},
                                           {{0.00f, 0.45f, 0.70f}, {}, Marker::kTriangle},
                                           {{0.00f, 0.50f, 0.37f}, {2, 2.5}, Marker::kDiamond},
                                           {{0.60f, 0.30f, 0.50f}, {8, 3, 2, 3}, Marker::kCross},
                                           {{0.45f, 0.45f, 0.45f}, {4, 2}, Marker::kPlus}}};
  return kLooks[size_t(style) % kLooks.size()];
}

/// A logarithmic axis over whole decades or a given range.
struct Axis {
  double from = 0.1, to = 10;
  double place(double value) const { return std::log(value / from) / std::log(to / from); }
};

bool isShown(double value) {
  return std::isfinite(value) && value > 0;
}

Axis axisOf(const Chart& chart, bool isX) {
  double low = INFINITY, high = 0;
  for (const Series& series : chart.series)
    for (size_t i = 0; i < series.x.size(); ++i) {
      if (!isShown(series.x[i]) || !isShown(series.y[i])) continue;
      const double value = isX ? series.x[i] : series.y[i];
      low = std::min(low, value);
      high = std::max(high, value);
    }
  if (!(high > 0)) return {};
  if (isX) return {low / 1.25, high * 1.25};
  Axis axis{std::pow(10, std::floor(std::log10(low) - 1e-9)),
            std::pow(10, std::ceil(std::log10(high) + 1e-9))};
  if (chart.yFrom > 0) axis.from = chart.yFrom;
  if (chart.yTo > 0) axis.to = chart.yTo;
  return axis;
}

struct Tick {
  double value;
  bool major;
};

/// The decades, and between them 2 and 5 (labelled where there are few decades).
std::vector<Tick> ticksOf(const Axis& axis) {
  std::vector<Tick> ticks;
  const bool few = std::log10(axis.to / axis.from) < 2.2;
  for (int decade = int(std::floor(std::log10(axis.from))); decade <= int(std::ceil(std::log10(axis.to)));
       ++decade)
    for (int digit = 1; digit < 10; ++digit) {
      const double value = digit * std::pow(10, decade);
      if (value < axis.from * 0.999 || value > axis.to * 1.001) continue;
      ticks.push_back({value, digit == 1 || (few && (digit == 2 || digit == 5))});
    }
  return ticks;
}

glm::dvec2 pointOf(const Axis& x, const Axis& y, double vx, double vy) {
  return {kFrom.x + kSize.x * x.place(vx), kFrom.y + kSize.y * (1 - y.place(vy))};
}

void drawAxes(Canvas& canvas, const Chart& chart, const Axis& x, const Axis& y) {
  for (const bool major : {false, true}) {
    const Stroke grid{.colour = glm::vec3(major ? kGrid : kMinorGrid), .width = 0.7};
    for (const Tick& tick : ticksOf(x))
      if (tick.major == major)
        canvas.line({pointOf(x, y, tick.value, y.from), pointOf(x, y, tick.value, y.to)}, grid);
    for (const Tick& tick : ticksOf(y))
      if (tick.major == major)
        canvas.line({pointOf(x, y, x.from, tick.value), pointOf(x, y, x.to, tick.value)}, grid);
  }
  canvas.rectangle(kFrom, kSize, {.width = 0.9});
  for (const Tick& tick : ticksOf(x))
    if (tick.major)
      canvas.text(fmt::format("{:g}", tick.value), pointOf(x, y, tick.value, y.from) + glm::dvec2(0, 16),
                  kText, Anchor::kCentre);
  for (const Tick& tick : ticksOf(y))
    if (tick.major)
      canvas.text(fmt::format("{:g}", tick.value), pointOf(x, y, x.from, tick.value) + glm::dvec2(-6, 4),
                  kText, Anchor::kRight);
  canvas.text(chart.xLabel, {kFrom.x + kSize.x / 2, kFrom.y + kSize.y + 36}, kText + 0.5, Anchor::kCentre);
  canvas.text(chart.yLabel, {16, kFrom.y + kSize.y / 2}, kText + 0.5, Anchor::kCentre, true);
  canvas.text(chart.title, {kFrom.x, 20}, kText + 2);
}

void drawSeries(Canvas& canvas, const Series& series, const Axis& x, const Axis& y) {
  const Look& look = lookOf(series.style);
  std::vector<glm::dvec2> points;
  for (size_t i = 0; i < series.x.size(); ++i)
    if (isShown(series.x[i]) && isShown(series.y[i]))
      points.push_back(pointOf(x, y, series.x[i], series.y[i]));
  canvas.clip(kFrom - glm::dvec2(4), kSize + glm::dvec2(8));
  canvas.line(points, {.colour = look.colour, .width = 1.5, .dashes = look.dashes});
  for (const glm::dvec2& point : points) canvas.marker(look.marker, point, 7, look.colour);
  canvas.unclip();
}

/// Below the plot, in one line.
void drawLegend(Canvas& canvas, const Chart& chart) {
  constexpr double kLine = 24, kGap = 12, kSmall = 10.5;
  double width = -kGap;
  for (const Series& series : chart.series)
    width += kLine + 5 + canvas.textWidth(series.label, kSmall) + kGap;
  double left = std::max(4.0, (kWidth - width) / 2);
  const double top = kHeight - 10;
  for (const Series& series : chart.series) {
    const Look& look = lookOf(series.style);
    canvas.line({{left, top - 4}, {left + kLine, top - 4}},
                {.colour = look.colour, .width = 1.5, .dashes = look.dashes});
    canvas.marker(look.marker, {left + kLine / 2, top - 4}, 6.5, look.colour);
    canvas.text(series.label, {left + kLine + 5, top}, kSmall);
    left += kLine + 5 + canvas.textWidth(series.label, kSmall) + kGap;
  }
}

}  // namespace

void writeChart(const Chart& chart, const std::filesystem::path& path) {
  writeAtomically(path, [&](const std::filesystem::path& temporary) {
    Canvas canvas(temporary, kWidth, kHeight);
    const Axis x = axisOf(chart, true), y = axisOf(chart, false);
    drawAxes(canvas, chart, x, y);
    for (const Series& series : chart.series) drawSeries(canvas, series, x, y);
    if (chart.legend) drawLegend(canvas, chart);
    canvas.finish();
  });
}

}  // namespace lychnite::paper
