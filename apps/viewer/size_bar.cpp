#include <fmt/format.h>

#include <array>
#include <cmath>

#include "controls.h"
#include "lychnite/app/scene_moves.h"
#include "lychnite/base/error.h"
#include "lychnite/base/units.h"

namespace lychnite::viewer {
namespace {

constexpr double kLeast = 0.1, kMost = 10000;  // mm

struct Familiar {
  const char* name;
  double mm;
};
constexpr std::array<Familiar, 8> kFamiliar{{{"grain of salt", 0.3},
                                             {"sesame seed", 3},
                                             {"fingertip", 15},
                                             {"chess king", 95},
                                             {"wine bottle", 300},
                                             {"child", 1100},
                                             {"car", 4200},
                                             {"bus", 10000}}};

double shareOf(double mm) {
  return std::log(mm / kLeast) / std::log(kMost / kLeast);
}

double sizeAt(double share) {
  return kLeast * std::pow(kMost / kLeast, std::clamp(share, 0.0, 1.0));
}

/// Three digits are as exact as a hand is.
double rounded(double mm) {
  const double step = std::pow(10, std::floor(std::log10(mm)) - 2);
  return std::round(mm / step) * step;
}

void drawScale(PanelContext& context, const Area& track, double size) {
  const float s = float(context.ui.scale());
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 faint = ImGui::GetColorU32(ImGuiCol_TextDisabled),
              line = ImGui::GetColorU32(ImGuiCol_FrameBgActive);
  const float y = float(0.5 * (track.low.y + track.high.y));
  const auto x = [&](double mm) { return float(track.low.x + shareOf(mm) * track.size().x); };
  draw.AddRectFilled({float(track.low.x), y - 2 * s}, {float(track.high.x), y + 2 * s},
                     ImGui::GetColorU32(ImGuiCol_FrameBg), 2 * s);
  draw.AddRectFilled({float(track.low.x), y - 2 * s}, {x(size), y + 2 * s},
                     ImGui::GetColorU32(ImGuiCol_SliderGrab), 2 * s);
  const float font = ImGui::GetFontSize() * 0.86f;
  // Words that would touch the ones before are left out.
  const auto write = [&](const char* words, float at, float from, float& end) {
    const float width = ImGui::CalcTextSize(words).x * 0.86f;
    const float left = std::min(at - width / 2, float(track.high.x) + 14 * s - width);
    if (left < end + 8 * s) return;
    end = left + width;
    draw.AddText(ImGui::GetFont(), font, {left, from}, faint, words);
  };
  float lengthsEnd = 0, namesEnd = 0;
  for (double decade = kLeast; decade <= kMost * 1.001; decade *= 10) {
    for (int i = 1; i < 10 && decade * i <= kMost * 1.001; ++i)
      draw.AddLine({x(decade * i), y + 5 * s}, {x(decade * i), y + (i == 1 ? 10 : 7) * s}, line, s);
    write(formatLength(decade).c_str(), x(decade), y + 11 * s, lengthsEnd);
  }
  for (const Familiar& familiar : kFamiliar) {
    draw.AddCircleFilled({x(familiar.mm), y - 8 * s}, 1.6f * s, faint);
    write(familiar.name, x(familiar.mm), y - 25 * s, namesEnd);
  }
  draw.AddCircleFilled({x(size), y}, 7 * s, ImGui::GetColorU32(ImGuiCol_SliderGrabActive), 24);
}

void dragTrack(PanelContext& context, const Area& track, double size) {
  const double s = context.ui.scale();
  ImGui::SetCursorScreenPos({float(track.low.x - 8 * s), float(track.low.y)});
  ImGui::InvisibleButton("track", {float(track.size().x + 16 * s), float(track.size().y)});
  context.ui.mark("size", track);
  if (ImGui::IsItemActive()) {
    const double share = (double(ImGui::GetIO().MousePos.x) - track.low.x) / track.size().x;
    const double wanted = rounded(sizeAt(share));
    if (wanted != size) setSubjectSize(context.session.state().scene, wanted);
  } else if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip(
        "True size: the longest side of the object's box. Drag, type, or halve and double with [ and ].\n"
        "The camera keeps the object's size on the screen: only the light changes.");
  }
}

void typeSize(PanelContext& context, double size) {
  Controls& controls = context.controls;
  if (!controls.editsSize) controls.sizeText = formatLength(size);
  std::array<char, 64> text{};
  controls.sizeText.copy(text.data(), text.size() - 1);
  const bool entered =
      ImGui::InputText("##length", text.data(), text.size(),
                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  context.ui.mark("size-text");
  controls.editsSize = ImGui::IsItemActive();
  controls.sizeText = text.data();
  if (!entered) return;
  controls.editsSize = false;
  try {
    const double wanted = parseLength(text.data(), "size");
    if (!(wanted >= kLeast && wanted <= kMost))
      throw Error({.where = "size", .expected = "0.1 mm to 10 m", .found = text.data(), .todo = ""});
    setSubjectSize(context.session.state().scene, wanted);
  } catch (const std::exception& error) {
    context.session.say(error.what(), true);
  }
}

}  // namespace

void drawSizeBar(PanelContext& context, const Area& area) {
  ImGui::SetNextWindowPos(toIm(area.low));
  ImGui::SetNextWindowSize(toIm(area.size()));
  ImGui::Begin("size bar", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
  if (!context.session.empty()) {
    const Scene& scene = context.session.state().scene;
    const double size = scene.objects[subjectIndex(scene)].size, s = context.ui.scale();
    ImGui::SetCursorScreenPos({float(area.low.x + 12 * s), float(area.low.y + 22 * s)});
    ImGui::SetNextItemWidth(float(84 * s));
    typeSize(context, size);
    const Area track{{area.low.x + 124 * s, area.low.y + 14 * s},
                     {area.high.x - 30 * s, area.high.y - 14 * s}};
    if (track.size().x > 40) {
      drawScale(context, track, scene.objects[subjectIndex(scene)].size);
      dragTrack(context, track, scene.objects[subjectIndex(scene)].size);
    }
  }
  ImGui::End();
}

}  // namespace lychnite::viewer
