#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "controls.h"
#include "lychnite/base/units.h"

namespace lychnite::viewer {
namespace {

const ImU32 kInk = IM_COL32(178, 180, 184, 255), kFaint = IM_COL32(128, 130, 134, 255);

/// Broken into lines as wide as `room`; 0: one line.
void text(ImDrawList& draw, glm::dvec2 at, ImU32 colour, const std::string& words, double room = 0) {
  const auto write = [&](const ImVec2& from, ImU32 ink) {
    draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), from, ink, words.c_str(), nullptr, float(room));
  };
  write({float(at.x) + 1, float(at.y) + 1}, IM_COL32(0, 0, 0, 160));
  write(toIm(at), colour);
}

/// A ruler along the longest side of the object's box, which is what its size means, at the box's left or
/// lower edge as the camera sees it.
struct Ruler {
  glm::dvec3 origin{0}, along{0}, out{0};  ///< in mm; the directions are unit vectors
};

std::optional<Ruler> rulerOf(const Object& subject, const CameraFrame& camera) {
  const glm::dvec3 extent = extentOf(*subject.mesh).bounds.extent();
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  Ruler ruler;
  ruler.along[axis] = 1;
  ruler.along = subject.rotation * ruler.along;
  const double upwards = glm::dot(ruler.along, camera.up), rightwards = glm::dot(ruler.along, camera.right);
  if (upwards * upwards + rightwards * rightwards < 0.1) return {};  // seen from its end
  const bool stands = std::abs(upwards) > std::abs(rightwards);
  if ((stands ? upwards : rightwards) < 0) ruler.along = -ruler.along;
  const glm::dvec3 wanted = stands ? -camera.right : -camera.up;
  ruler.out = glm::normalize(wanted - ruler.along * glm::dot(wanted, ruler.along));
  double reach = 0;
  const double scale = placementOf(subject).scale;
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 side(0);
    side[i] = 0.5 * extent[i] * scale;
    reach += std::abs(glm::dot(subject.rotation * side, ruler.out));
  }
  ruler.origin =
      subject.position + ruler.out * (reach + 0.06 * subject.size) - ruler.along * (0.5 * subject.size);
  return ruler;
}

void drawRuler(PanelContext& context, ImDrawList& draw, const Area& area) {
  const Scene& scene = context.view.shownScene(context.session.state());
  const Object& subject = scene.objects[subjectIndex(scene)];
  const CameraFrame camera =
      cameraFrame(scene, std::max(1, int(area.size().x)), std::max(1, int(area.size().y)));
  const auto ruler = rulerOf(subject, camera);
  if (!ruler) return;
  const float s = float(context.ui.scale());
  const auto first = onWindow(camera, area, ruler->origin);
  const auto last = onWindow(camera, area, ruler->origin + ruler->along * subject.size);
  if (!first || !last) return;
  draw.AddLine(toIm(*first), toIm(*last), kFaint, s);
  const double step = gridSpacing(scene);
  const int ticks = int(subject.size / step + 1e-6);
  const ImVec2 widest =
      ImGui::CalcTextSize(formatLength(std::stod(fmt::format("{:.6g}", ticks * step))).c_str());
  const glm::dvec2 way = glm::abs(glm::normalize(*last - *first + glm::dvec2(1e-9, 0)));
  const double room = glm::distance(*first, *last) / (subject.size / step),
               needed = glm::dot(way, fromIm(widest)) + 10 * double(s);
  const int every = room > needed ? 1 : 2 * room > needed ? 2 : 5;
  for (int i = 0; i <= ticks; ++i) {
    const bool labelled = i % every == 0;
    const glm::dvec3 at = ruler->origin + ruler->along * (i * step);
    const auto low = onWindow(camera, area, at),
               high = onWindow(camera, area, at + ruler->out * (labelled ? 0.03 : 0.015) * subject.size);
    if (!low || !high) return;
    draw.AddLine(toIm(*low), toIm(*high), kFaint, s);
    if (!labelled) continue;
    const std::string label = i == 0 ? "0" : formatLength(std::stod(fmt::format("{:.6g}", i * step)));
    const ImVec2 size = ImGui::CalcTextSize(label.c_str());
    const glm::dvec2 away = glm::normalize(*high - *low + glm::dvec2(1e-9, 0));
    const glm::dvec2 centre =
        *high +
        away * (0.5 * (std::abs(away.x) * double(size.x) + std::abs(away.y) * double(size.y)) + 4 * s);
    text(draw, centre - 0.5 * fromIm(size), kFaint, label);
  }
}

/// What is other in the variant: "adaptive, skin1, 25 mm".
std::string differences(const Variant& variant) {
  std::vector<std::string> parts;
  if (variant.method) parts.push_back(methodName(*variant.method));
  if (variant.samples) parts.push_back(fmt::format("{} samples", *variant.samples));
  if (variant.profile) parts.push_back(profileName(*variant.profile));
  if (variant.material) parts.push_back(variant.material->name);
  if (variant.size) parts.push_back(formatLength(*variant.size));
  return fmt::format("{}", fmt::join(parts, ", "));
}

void drawWipe(PanelContext& context, ImDrawList& draw, const Area& area) {
  static const char* const kNames[] = {"This scene", "Variant", "Truth (walk)", "Opened picture"};
  const CompareView& compare = context.session.state().compare;
  const float s = float(context.ui.scale());
  const double x = area.low.x + compare.wipe * area.size().x;
  const auto name = [&](CompareView::Source source) {
    std::string how = context.view.labelOf(source);
    if (how.empty() && source == CompareView::Source::kVariant)
      how = differences(context.session.state().variant);
    return kNames[int(source)] + (how.empty() ? "" : ": " + how);
  };
  const std::string left = name(compare.left), right = name(compare.right);
  if (compare.mode == CompareView::Mode::kDifference) {
    text(draw, area.low + glm::dvec2(12 * s, 10 * s), kInk,
         fmt::format("|{} - {}| over the mean of the right", left, right), area.size().x - 24 * s);
    if (context.view.available(compare.left) && context.view.available(compare.right))
      drawColourBar(context, area);
    return;
  }
  draw.AddLine({float(x), float(area.low.y)}, {float(x), float(area.high.y)}, IM_COL32(230, 230, 230, 150),
               s);
  const glm::dvec2 grip(x, area.high.y - 40 * s);
  draw.AddCircleFilled(toIm(grip), 6 * s, IM_COL32(230, 230, 230, 210), 20);
  context.ui.mark("wipe", {grip - glm::dvec2(6 * s), grip + glm::dvec2(6 * s)});
  const double width = double(ImGui::CalcTextSize(left.c_str()).x);
  const double from = std::max(area.low.x + 12 * s, x - width - 10 * s);
  // Where there is no room for the left one before the line, the right one goes below it.
  const double down = from + width > x ? 10 * s + double(ImGui::GetTextLineHeightWithSpacing()) : 10 * s;
  text(draw, {from, area.low.y + 10 * s}, kInk, left);
  text(draw, {x + 10 * s, area.low.y + down}, kInk, right, std::max(60.0 * s, area.high.x - x - 20 * s));
}

/// The chosen light's direction, while the hand turns it.
void drawLight(PanelContext& context, ImDrawList& draw, const Area& area) {
  const Scene& scene = context.session.state().scene;
  if (context.controls.light >= scene.lights.size()) return;
  Sphere sphere = boundingSphere(scene, true);
  if (sphere.radius == 0) sphere = boundingSphere(scene);
  const Light& light = scene.lights[context.controls.light];
  glm::dvec3 direction(0, 1, 0);
  if (const auto* parallel = std::get_if<ParallelLight>(&light))
    direction = directionFromAngles(parallel->azimuth, parallel->elevation);
  else
    direction = glm::normalize(std::get<PointLight>(light).position - sphere.centre);
  const CameraFrame camera =
      cameraFrame(scene, std::max(1, int(area.size().x)), std::max(1, int(area.size().y)));
  const auto from = onWindow(camera, area, sphere.centre + direction * (1.25 * sphere.radius));
  const auto to = onWindow(camera, area, sphere.centre + direction * (0.85 * sphere.radius));
  if (!from || !to) return;
  const float s = float(context.ui.scale());
  draw.AddLine(toIm(*from), toIm(*to), IM_COL32(230, 180, 100, 220), 2 * s);
  draw.AddCircleFilled(toIm(*from), 5 * s, IM_COL32(240, 190, 110, 240), 20);
}

void drawMessages(ImDrawList& draw, const Area& area, double s, const std::vector<SessionMessage>& messages) {
  double y = area.high.y - 12 * s;
  for (auto message = messages.rbegin(); message != messages.rend(); ++message) {
    const ImVec2 size = ImGui::GetFont()->CalcTextSizeA(ImGui::GetFontSize(), 1e9f,
                                                        float(area.size().x - 40 * s), message->text.c_str());
    y -= double(size.y) + 10 * s;
    const ImVec2 low{float(area.low.x + 12 * s), float(y)},
        high{low.x + size.x + float(16 * s), float(y + double(size.y) + 6 * s)};
    draw.AddRectFilled(low, high, IM_COL32(34, 34, 36, 235), float(3 * s));
    draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {low.x + float(8 * s), low.y + float(3 * s)},
                 message->problem ? IM_COL32(240, 150, 120, 255) : kInk, message->text.c_str(), nullptr,
                 float(area.size().x - 40 * s));
  }
}

/// How to find out the rest.
void drawHint(ImDrawList& draw, const Area& area, double s) {
  const std::string hint = "H: keys";
  const double width = double(ImGui::CalcTextSize(hint.c_str()).x);
  text(draw, {area.high.x - width - 12 * s, area.low.y + 10 * s}, kFaint, hint);
}

void drawKeys(ImDrawList& draw, const Area& area, double s) {
  static const char* const kKeys[][2] = {{"Drag", "turn the camera"},
                                         {"Shift+drag, right drag", "turn the chosen light"},
                                         {"Middle drag, Ctrl+drag", "pan"},
                                         {"Wheel", "nearer, farther"},
                                         {"F", "fit"},
                                         {"1 to 9", "views"},
                                         {"[  ]", "half, double size"},
                                         {"Space", "orbit the lights"},
                                         {"M", "next method"},
                                         {"P", "play the model's animation"},
                                         {"G", "ruler and grid"},
                                         {"C, D", "wipe, difference"},
                                         {"I", "samples under the mouse"},
                                         {"Ctrl+Z, Ctrl+Shift+Z", "undo, redo"},
                                         {"Ctrl+S", "save the scene"},
                                         {"Ctrl+P, Ctrl+Shift+P", "write a PNG, an EXR"},
                                         {"H", "these keys"},
                                         {"Ctrl+Q", "leave"}};
  const double line = double(ImGui::GetTextLineHeightWithSpacing());
  const glm::dvec2 at = area.low + glm::dvec2(16 * s, 40 * s);
  draw.AddRectFilled(toIm(at - glm::dvec2(10 * s)),
                     toIm(at + glm::dvec2(360 * s, line * double(std::size(kKeys)) + 10 * s)),
                     IM_COL32(28, 28, 30, 250), float(4 * s));
  for (size_t i = 0; i < std::size(kKeys); ++i) {
    text(draw, at + glm::dvec2(0, line * double(i)), kInk, kKeys[i][0]);
    text(draw, at + glm::dvec2(180 * s, line * double(i)), kFaint, kKeys[i][1]);
  }
}

}  // namespace

std::optional<glm::dvec2> onWindow(const CameraFrame& camera, const Area& area, const glm::dvec3& point) {
  const glm::dvec3 p = camera.project(point);
  if (p.z <= 0) return {};
  return area.low + glm::dvec2(p.x, p.y);
}

void drawOverlay(PanelContext& context, const Area& area, const std::vector<SessionMessage>& messages) {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const double s = context.ui.scale();
  draw.PushClipRect(toIm(area.low), toIm(area.high));
  context.ui.mark("picture", area);
  if (!context.session.empty() && context.session.state().inspect.layer == Inspect::Layer::kPicture) {
    const ViewState& state = context.session.state();
    if (state.ruler && state.compare.mode != CompareView::Mode::kDifference && !state.inspect.samples)
      drawRuler(context, draw, area);
    if (state.ruler && state.compare.mode == CompareView::Mode::kOff) drawHint(draw, area, s);
    if (state.compare.mode != CompareView::Mode::kOff)
      drawWipe(context, draw, area);
    else
      text(draw, area.low + glm::dvec2(12 * s, 10 * s), kFaint,
           context.view.labelOf(CompareView::Source::kView));
    if (state.inspect.samples) drawSamples(context, area);
    if (context.controls.turnsLight) drawLight(context, draw, area);
  }
  if (context.session.empty())
    text(draw, 0.5 * (area.low + area.high) - glm::dvec2(60 * s, 0), kFaint,
         context.session.loading() ? "Loading..." : "Drop a model here");
  drawMessages(draw, area, s, messages);
  if (context.controls.showKeys) drawKeys(draw, area, s);
  draw.PopClipRect();
}

}  // namespace lychnite::viewer
