// The samples of the pixel under the mouse: where its light is taken from.
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "controls.h"
#include "lychnite/base/units.h"

namespace lychnite::viewer {
namespace {

double mean(const Rgb& c) {
  return (c.x + c.y + c.z) / 3;
}

/// As the difference view's scale (shaders/view/display.frag), without its black end.
ImU32 heat(double t, int alpha) {
  constexpr double kScale[4][3] = {{101, 40, 140}, {183, 55, 121}, {252, 137, 97}, {252, 253, 191}};
  const double place = std::clamp(t, 0.0, 1.0) * 3;
  const int low = std::min(2, int(place));
  const double f = place - low;
  int c[3];
  for (int i = 0; i < 3; ++i) c[i] = int((1 - f) * kScale[low][i] + f * kScale[low + 1][i]);
  return IM_COL32(c[0], c[1], c[2], alpha);
}

/// A sample's footprint as a square, the fainter inside the larger it is, so that what lies below stays
/// visible.
void square(ImDrawList& draw, const glm::dvec2& at, double side, double share, float scale) {
  const float half = std::max(float(0.5 * side), 1.5f * scale);
  const ImVec2 low{float(at.x) - half, float(at.y) - half}, high{float(at.x) + half, float(at.y) + half};
  draw.AddRectFilled(low, high, heat(share, std::clamp(int(1600 * scale / half), 14, 80)));
  draw.AddRect(low, high, heat(share, 220), 0, 0, scale);
}

void cross(ImDrawList& draw, const glm::dvec2& at, float scale) {
  const auto line = [&](const glm::dvec2& by) {
    draw.AddLine(toIm(at - by), toIm(at + by), IM_COL32(120, 220, 255, 255), 1.5f * scale);
  };
  line({5.0 * double(scale), 0});
  line({0, 5.0 * double(scale)});
}

void drawNumbers(const SeenSamples& seen, const Scene& scene, int light) {
  const auto strongest = std::max_element(
      seen.samples.begin(), seen.samples.end(),
      [](const SeenSample& a, const SeenSample& b) { return mean(a.radiosity) < mean(b.radiosity); });
  double least = 1e9, most = 0, sum = 0;
  int lit = 0;
  for (const SeenSample& sample : seen.samples) {
    const double value = mean(sample.radiosity);
    if (value <= 0) continue;
    ++lit;
    sum += value;
    least = std::min(least, sample.level);
    most = std::max(most, sample.level);
  }
  const double all = mean(seen.radiosity);
  ImGui::BeginTooltip();
  ImGui::Text("Light %d: %d of %d samples bring light, mip levels %.1f to %.1f", light + 1, lit,
              int(seen.samples.size()), lit > 0 ? least : 0.0, most);
  ImGui::Text("Radiosity %.4g  %.4g  %.4g", seen.radiosity.x, seen.radiosity.y, seen.radiosity.z);
  if (all > 0 && lit > 0) {
    const double across = glm::distance(strongest->position, seen.receiver);
    ImGui::Text("Strongest sample: %.1f %%, %s away, %s wide, level %.1f",
                100 * mean(strongest->radiosity) / all,
                formatLength(std::stod(fmt::format("{:.2g}", across))).c_str(),
                formatLength(std::stod(fmt::format("{:.2g}", strongest->side))).c_str(), strongest->level);
    ImGui::Text("Samples together: %.1f %%", 100 * sum / all);
  }
  if (seen.receivers > 1) ImGui::Text("The pixel's first of %d surface points", seen.receivers);
  if (size_t(light) >= scene.lights.size()) ImGui::TextUnformatted("There is no such light");
  ImGui::EndTooltip();
}

}  // namespace

void drawSamples(PanelContext& context, const Area& area) {
  const ViewState& state = context.session.state();
  const glm::dvec2 mouse = fromIm(ImGui::GetIO().MousePos);
  if (!area.holds(mouse) || context.ui.wantsMouse()) return;
  if (state.settings.method == Method::kVolume && state.compare.mode == CompareView::Mode::kOff)
    return ImGui::SetTooltip("volume takes no samples at a pixel: its light is solved for in cells");
  const auto& seen = context.view.samplesAt((mouse - area.low) / area.size(), state);
  if (!seen) return;
  const float s = float(context.ui.scale());
  std::vector<SeenSample> samples = seen->samples;
  std::erase_if(samples, [](const SeenSample& sample) { return mean(sample.radiosity) <= 0; });
  std::sort(samples.begin(), samples.end(),
            [](const SeenSample& a, const SeenSample& b) { return mean(a.radiosity) < mean(b.radiosity); });
  const double most = samples.empty() ? 1 : mean(samples.back().radiosity);
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const CameraFrame camera =
      cameraFrame(state.scene, std::max(1, int(area.size().x)), std::max(1, int(area.size().y)));
  const Area inset = mapInset(area);
  context.ui.mark("map-inset", inset);
  const auto onMap = [&](const glm::dvec2& uv) {
    return inset.low + glm::dvec2(uv.x, 1 - uv.y) * inset.size();
  };
  for (const SeenSample& sample : samples) {
    const double share = std::sqrt(mean(sample.radiosity) / most);
    draw.PushClipRect(toIm(inset.low), toIm(inset.high), true);
    square(draw, onMap(sample.uv), sample.width * inset.size().x, share, s);
    draw.PopClipRect();
    const auto at = onWindow(camera, area, sample.position);
    const double depth = glm::dot(sample.position - camera.position, camera.forward);
    if (at && depth > 0)
      square(draw, *at, sample.side / depth * 0.5 * area.size().y / camera.tanHalfFovY, share, s);
  }
  draw.AddRect(toIm(inset.low), toIm(inset.high), IM_COL32(128, 130, 134, 255), 0, 0, s);
  cross(draw, onMap(seen->receiverUv), s);
  if (const auto at = onWindow(camera, area, seen->receiver)) cross(draw, *at, s);
  drawNumbers(*seen, state.scene, state.inspect.light);
}

}  // namespace lychnite::viewer
