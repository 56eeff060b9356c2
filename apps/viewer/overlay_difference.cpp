// The legend of the difference view: its false colours and the relative errors that they stand for.
#include <fmt/format.h>

#include <cmath>

#include "controls.h"

namespace lychnite::viewer {
namespace {

constexpr double kWidth = 12, kHeight = 150, kGap = 12, kTick = 4;  // at scale 1

/// As heat() of shaders/view/display.frag.
constexpr int kColours[5][3] = {{0, 0, 4}, {81, 18, 124}, {183, 55, 121}, {252, 137, 97}, {252, 253, 191}};

ImU32 colour(int i) {
  return IM_COL32(kColours[i][0], kColours[i][1], kColours[i][2], 255);
}

/// 1, 2 or 5 times a power of ten, of which four to ten fill `full`.
double niceStep(double full) {
  const double decade = std::pow(10, std::floor(std::log10(full)));
  const double leading = full / decade;
  return decade * (leading < 2 ? 0.2 : leading < 5 ? 0.5 : 1);
}

void drawTick(ImDrawList& draw, const glm::dvec2& at, double s, const std::string& label) {
  constexpr ImU32 kInk = IM_COL32(178, 180, 184, 255);
  draw.AddLine(toIm(at - glm::dvec2(kTick * s, 0)), toIm(at), kInk, float(s));
  const ImVec2 size = ImGui::CalcTextSize(label.c_str());
  draw.AddText({float(at.x - (kTick + 4) * s) - size.x, float(at.y) - 0.5f * size.y}, kInk, label.c_str());
}

}  // namespace

void drawColourBar(PanelContext& context, const Area& area) {
  const double s = context.ui.scale(), height = std::min(kHeight * s, 0.5 * area.size().y);
  const glm::dvec2 high = area.high - glm::dvec2(kGap * s), low = high - glm::dvec2(kWidth * s, height);
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  for (int i = 0; i < 4; ++i) {
    const double top = high.y - height * (i + 1) / 4, bottom = high.y - height * i / 4;
    draw.AddRectFilledMultiColor({float(low.x), float(top)}, {float(high.x), float(bottom)}, colour(i + 1),
                                 colour(i + 1), colour(i), colour(i));
  }
  draw.AddRect(toIm(low), toIm(high), IM_COL32(128, 130, 134, 255), 0, 0, float(s));
  context.ui.mark("colour-bar", {low, high});
  const double full = 100 * context.session.state().compare.full;
  const double step = niceStep(full), room = double(ImGui::GetTextLineHeight()) / height * full;
  const int every = step < room ? 2 : 1;
  for (int i = 0; i * step < full - room; i += every)
    drawTick(draw, {low.x, high.y - height * i * step / full}, s, fmt::format("{:.3g} %", i * step));
  drawTick(draw, low, s, fmt::format("≥ {:.3g} %", full));
}

}  // namespace lychnite::viewer
