// The legend of the difference view: its false colours and the relative errors that they stand for.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "controls.h"
#include "lychnite/image/metrics.h"

namespace lychnite::viewer {
namespace {

constexpr double kThickness = 12, kGap = 12, kTick = 4;  // at scale 1
constexpr double kUpright = 150, kLying = 220;           // lengths, likewise
constexpr double kBeside =
    160;  // by so much a picture must be wider than high to have room beside the object
constexpr ImU32 kInk = IM_COL32(178, 180, 184, 255);

/// Of a quarter of the scale's length each: the knots between which it is linear.
ImU32 colour(int quarter) {
  const glm::vec3 c = errorColour(0.25 * quarter);
  return ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, 1});
}

/// 1, 2 or 5 times a power of ten, of which four to ten fill `full`.
double niceStep(double full) {
  const double decade = std::pow(10, std::floor(std::log10(full)));
  const double leading = full / decade;
  return decade * (leading < 2 ? 0.2 : leading < 5 ? 0.5 : 1);
}

/// The bar in the lower right corner: upright, or lying where the object fills the width.
struct Bar {
  glm::dvec2 low{0}, high{0}, along{0};  ///< the window's corners; from the scale's beginning to its end
  glm::dvec2 at(double share) const {
    return (along.x > 0 ? low : glm::dvec2(low.x, high.y)) + share * along;
  }
};

Bar barOf(const Area& area, double s) {
  Bar bar;
  bar.high = area.high - glm::dvec2(kGap * s);
  if (area.size().x > area.size().y + kBeside * s)
    bar.along = {0, -std::min(kUpright * s, 0.5 * area.size().y)};
  else
    bar.along = {std::min(kLying * s, area.size().x - 4 * kGap * s), 0};
  const glm::dvec2 size =
      bar.along.x > 0 ? glm::dvec2(bar.along.x, kThickness * s) : glm::dvec2(kThickness * s, -bar.along.y);
  bar.low = bar.high - size;
  return bar;
}

void drawColours(ImDrawList& draw, const Bar& bar) {
  const bool lies = bar.along.x > 0;
  for (int i = 0; i < 4; ++i) {
    const glm::dvec2 a = bar.at(0.25 * i), b = bar.at(0.25 * (i + 1));
    const ImU32 from = colour(i), to = colour(i + 1);
    if (lies)
      draw.AddRectFilledMultiColor(toIm(a), {float(b.x), float(bar.high.y)}, from, to, to, from);
    else
      draw.AddRectFilledMultiColor(toIm(b), {float(bar.high.x), float(a.y)}, to, to, from, from);
  }
}

/// Before the bar: left of an upright one, above a lying one.
void drawTick(ImDrawList& draw, const Bar& bar, double share, double s, const std::string& label) {
  const bool lies = bar.along.x > 0;
  const glm::dvec2 at = bar.at(share), out = lies ? glm::dvec2(0, -1) : glm::dvec2(-1, 0);
  const glm::dvec2 size = fromIm(ImGui::CalcTextSize(label.c_str()));
  draw.AddLine(toIm(at), toIm(at + out * (kTick * s)), kInk, float(s));
  const glm::dvec2 centre = at + out * ((kTick + 3) * s + 0.5 * (lies ? size.y : size.x));
  glm::dvec2 from = centre - 0.5 * size;
  if (lies) from.x = std::min(from.x, bar.high.x + 0.5 * kGap * s - size.x);
  draw.AddText(toIm(from), kInk, label.c_str());
}

}  // namespace

void drawColourBar(PanelContext& context, const Area& area) {
  const double s = context.ui.scale();
  const Bar bar = barOf(area, s);
  if (glm::length(bar.along) < 20 * s) return;  // no room for one
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  drawColours(draw, bar);
  draw.AddRect(toIm(bar.low), toIm(bar.high), IM_COL32(128, 130, 134, 255), 0, 0, float(s));
  context.ui.mark("colour-bar", {bar.low, bar.high});
  const double full = 100 * context.session.state().compare.full, step = niceStep(full);
  const std::string last = fmt::format("≥ {:.3g} %", full);
  const glm::dvec2 text = fromIm(ImGui::CalcTextSize(last.c_str()));
  const double needed = bar.along.x > 0 ? text.x + 8 * s : text.y;
  const double room = needed / glm::length(bar.along) * full;  // in the scale's unit
  const int every = int(std::ceil(room / step));
  for (int i = 0; i * step < full - room; i += every)
    drawTick(draw, bar, i * step / full, s, fmt::format("{:.3g} %", i * step));
  drawTick(draw, bar, 1, s, last);
}

}  // namespace lychnite::viewer
