// Sections about how the picture is made and looked at: method, comparison, what is inside.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "controls.h"
#include "lychnite/base/units.h"
#include "lychnite/optics/materials.h"

namespace lychnite::viewer {
namespace {

const std::vector<ProfileKind>& profiles() {
  static const std::vector<ProfileKind> kinds{ProfileKind::kDipole, ProfileKind::kBetterDipole,
                                              ProfileKind::kNormalizedDiffusion, ProfileKind::kTabulated};
  return kinds;
}

template <class T>
int indexOf(const std::vector<T>& list, const T& value) {
  const auto found = std::find(list.begin(), list.end(), value);
  return found == list.end() ? 0 : int(found - list.begin());
}

std::vector<std::string> methodNames() {
  std::vector<std::string> names;
  for (const Method method : liveMethods()) names.push_back(methodName(method));
  return names;
}

std::vector<std::string> profileNames() {
  std::vector<std::string> names;
  for (const ProfileKind kind : profiles()) names.push_back(profileName(kind));
  return names;
}

void chooseProfile(Ui& ui, ProfileKind& profile) {
  int index = indexOf(profiles(), profile);
  if (ui.choice(
          "Profile",
          "How light spreads from where it enters: the dipole of Jensen et al. 2001, d'Eon's better dipole "
          "2012, Christensen & Burley's normalized diffusion 2015, or one measured by Monte Carlo.",
          index, profileNames()))
    profile = profiles()[size_t(index)];
}

void chooseMap(Ui& ui, RenderSettings& settings) {
  static const std::vector<int> sizes{0, 128, 256, 512, 1024, 2048, 4096};
  const RenderSettings usual;
  std::vector<std::string> names{"by the material"};
  for (size_t i = 1; i < sizes.size(); ++i) names.push_back(fmt::format("{} x {}", sizes[i], sizes[i]));
  int index = settings.mostMapSize > settings.mapSize ? 0 : indexOf(sizes, settings.mapSize);
  if (!ui.choice(
          "Map",
          "The light-space map: the object as the light sees it. By the material: 512 x 512, up to 2048 x "
          "2048 where the mean free path is short beside the object.",
          index, names))
    return;
  settings.mapSize = index == 0 ? usual.mapSize : sizes[size_t(index)];
  settings.mostMapSize = index == 0 ? usual.mostMapSize : settings.mapSize;
}

void drawResolution(PanelContext& context) {
  ViewState& state = context.session.state();
  double percent = 100 * state.resolution;
  if (context.ui.slider("Resolution, %",
                        "Of the picture at rest, over the window's own along each side. In motion it is "
                        "coarser where the machine is slow.",
                        percent, 20, 100, "%.0f"))
    state.resolution = std::round(percent) / 100;
}

void drawTone(PanelContext& context) {
  ViewState& state = context.session.state();
  Ui& ui = context.ui;
  ui.slider("Exposure, stops", "Doubles or halves the brightness with each step.", state.toneMapping.exposure,
            -8, 8, "%+.1f");
  int curve = state.toneMapping.curve == ToneMapping::Curve::kFilmic ? 1 : 0;
  if (ui.choice(
          "Tone curve",
          "sRGB shows values as they are and cuts off above white; filmic (Hable 2010) rolls off softly.",
          curve, {"sRGB", "Filmic"}))
    state.toneMapping.curve = curve == 1 ? ToneMapping::Curve::kFilmic : ToneMapping::Curve::kSrgb;
  ui.colour("Background", "Radiance behind the object.", state.scene.background);
  ui.check("Ruler and grid", "The ground's grid with its lengths. G.", state.ruler);
}

const std::vector<std::string>& sourceNames() {
  static const std::vector<std::string> names{"This scene", "Variant", "Truth (walk)", "Opened picture"};
  return names;
}

/// A value of the variant that is either its own or the scene's.
template <class T>
bool own(Ui& ui, const char* text, const char* help, std::optional<T>& value, const T& inherited) {
  bool has = value.has_value();
  if (ui.check(text, help, has)) value = has ? std::optional(inherited) : std::nullopt;
  return value.has_value();
}

void drawVariant(PanelContext& context) {
  ViewState& state = context.session.state();
  Variant& variant = state.variant;
  Ui& ui = context.ui;
  ui.note("What the variant does differently:");
  if (own(ui, "another method", "Another way to find the light, with all else the same.", variant.method,
          Method::kAdaptive)) {
    int index = indexOf(liveMethods(), *variant.method);
    if (ui.choice("Its method", "As Method under Picture.", index, methodNames()))
      variant.method = liveMethods()[size_t(index)];
  }
  if (own(ui, "other samples", "More or fewer samples a pixel: what is left of the difference is noise.",
          variant.samples, 128))
    ui.slider("Its samples", "Of multiple scattering at each pixel.", *variant.samples, 8, 128);
  if (own(ui, "another profile", "Another law of how light spreads, with all else the same.", variant.profile,
          ProfileKind::kBetterDipole)) {
    int index = indexOf(profiles(), *variant.profile);
    if (ui.choice("Its profile", "As Profile under Picture.", index, profileNames()))
      variant.profile = profiles()[size_t(index)];
  }
  const Object& subject = state.scene.objects[subjectIndex(state.scene)];
  if (own(ui, "another material", "Another medium of the library under the same coat.", variant.material,
          subject.material)) {
    std::vector<std::string> names;
    int index = 0;
    for (const NamedCoefficients& known : materialLibrary()) {
      if (known.name == variant.material->name) index = int(names.size());
      names.push_back(known.name);
    }
    if (ui.choice("Its material", "Measured coefficients, as in the library above.", index, names) ||
        variant.material->name == "custom") {
      variant.material->name = names[size_t(index)];
      variant.material->medium = materialLibrary()[size_t(index)].coefficients;
    }
  }
  if (own(ui, "another size", "The same object larger or smaller: only the light changes.", variant.size,
          5 * subject.size))
    ui.slider("Its size, mm", "The camera keeps the object's size on the screen.", *variant.size, 0.1, 10000,
              "%.4g", true);
}

void drawNumbers(PanelContext& context) {
  const CompareView& compare = context.session.state().compare;
  const bool truth =
      compare.left == CompareView::Source::kTruth || compare.right == CompareView::Source::kTruth;
  if (truth) {
    const auto walk = context.view.walk();
    if (!context.view.walkProblem().empty())
      context.ui.note(context.view.walkProblem());
    else if (walk)
      context.ui.note(fmt::format("Walk: noise {:.2f} %, {:.0f} s, {:.3g} photons a pixel", 100 * walk->noise,
                                  walk->seconds, walk->photonsPerPixel));
    else
      context.ui.note("The walk begins when the picture rests.");
  }
  if (const auto& error = context.view.error())
    context.ui.note(fmt::format("Relative RMSE {:.1f} %\nBias {:+.1f} %, SSIM {:.3f}",
                                100 * error->relative_rmse, 100 * error->bias, error->ssim));
  else if (!context.view.errorProblem().empty())
    context.ui.note(context.view.errorProblem());
  else
    context.ui.note("The error is found when both pictures rest.");
  Ui::help(
      "Left against right: root mean square difference over the mean of the right picture, over its covered "
      "pixels; "
      "against the walk, the walk's own noise is taken out.");
}

void drawSamplerError(PanelContext& context) {
  context.ui.label(
      "Sampling error",
      "Multiple scattering in a small picture of the scene at rest, against the same profile summed "
      "over the lit surface to 0.5 % (the dipole judge): relative RMSE and bias. It is what the "
      "method loses by its samples and its map, silhouettes included. It says nothing about the "
      "profile itself, nor about interpolation between pixels: for that, compare with the truth.");
  SamplerError& error = context.view.samplerError();
  if (const auto& found = error.found())
    ImGui::Text("%.1f %%, bias %+.1f %%", 100 * found->relative_rmse, 100 * found->bias);
  else if (!SamplerError::judges(context.session.state().settings))
    ImGui::TextUnformatted("none: not a sum");
  else
    ImGui::TextUnformatted(error.problem().empty() ? "..." : "none");
  context.ui.mark("sampling-error");
}

}  // namespace

const std::vector<Method>& liveMethods() {
  static const std::vector<Method> methods{Method::kVolume, Method::kMatched, Method::kAdaptive,
                                           Method::kFixed};
  return methods;
}

void drawMethodSection(PanelContext& context) {
  RenderSettings& settings = context.session.state().settings;
  Ui& ui = context.ui;
  int method = indexOf(liveMethods(), settings.method);
  if (ui.choice(
          "Method",
          "volume: photons and diffusion inside the object, solved on the processor, with no half-space "
          "assumption; for closed meshes, matched stands in elsewhere and until it is solved. matched: ours, "
          "samples follow the profile at the object's size. adaptive: Yao & Wang 2009. fixed: its fixed "
          "pattern.",
          method, methodNames()))
    settings.method = liveMethods()[size_t(method)];
  if (settings.method != Method::kVolume) chooseProfile(ui, settings.profile);
  if (settings.method == Method::kMatched)
    ui.slider("Samples", "Of multiple scattering at each pixel.", settings.multipleSamples, 8, 128);
  if (settings.method == Method::kVolume) {
    ui.slider("Cells", "Of the diffusion equation, along the object's longest side.", settings.cells, 16,
              128);
    ui.slider("Collisions", "Of each photon, traced before the diffusion equation takes over.",
              settings.collisions, 1, 24);
  }
  ui.slider("Along the ray", "Samples of single scattering along the refracted eye ray.",
            settings.singleSamples, 1, 64);
  chooseMap(ui, settings);
  drawResolution(context);
  ui.check("Multiple", "Light scattered more than once.", settings.components.multiple);
  ImGui::SameLine();
  ui.check("Single", "Light scattered once.", settings.components.single);
  ImGui::SameLine();
  ui.check("Surface", "Light mirrored by the coat.", settings.components.surface);
  drawTone(context);
}

void drawCompareSection(PanelContext& context) {
  CompareView& compare = context.session.state().compare;
  int mode = int(compare.mode);
  if (context.ui.choice(
          "Compare",
          "Wipe: left and right of a line that can be dragged. Difference: |left - right| in false "
          "colour. C and D.",
          mode, {"Off", "Wipe", "Difference"}))
    compare.mode = CompareView::Mode(mode);
  if (compare.mode == CompareView::Mode::kOff) return;
  int left = int(compare.left), right = int(compare.right);
  if (context.ui.choice("Left", "What is on the left of the line; in a difference, what is judged.", left,
                        sourceNames()))
    compare.left = CompareView::Source(left);
  if (context.ui.choice(
          "Right", "Truth: Monte Carlo light transport, refined on the processor while the picture rests.",
          right, sourceNames()))
    compare.right = CompareView::Source(right);
  if (compare.mode == CompareView::Mode::kDifference) {
    double percent = 100 * compare.full;
    if (context.ui.slider("Full scale, %", "The relative error that the brightest colour stands for.",
                          percent, 1, 400, "%.0f", true))
      compare.full = percent / 100;
  }
  drawNumbers(context);
  if (compare.left == CompareView::Source::kVariant || compare.right == CompareView::Source::kVariant)
    drawVariant(context);
}

void drawInspectSection(PanelContext& context) {
  ViewState& state = context.session.state();
  context.controls.inspects = true;
  int layer = int(state.inspect.layer);
  if (context.ui.choice("Show", "The picture, or what it is made from.", layer,
                        {"Picture", "Depth", "Normals", "Light-space map"}))
    state.inspect.layer = Inspect::Layer(layer);
  if (state.inspect.layer == Inspect::Layer::kMap || state.inspect.samples) {
    int shown = state.inspect.light + 1;
    if (context.ui.slider("Of light", "Each light has a map of its own.", shown, 1,
                          std::max(1, int(state.scene.lights.size()))))
      state.inspect.light = shown - 1;
  }
  if (state.inspect.layer == Inspect::Layer::kMap)
    context.ui.slider("Mip level",
                      "Each level is half as wide as the one before; far samples read coarse levels.",
                      state.inspect.mapLevel, 0, std::max(0, context.view.mapLevels() - 1));
  context.ui.check(
      "Samples under the mouse",
      "Where the light of the pixel under the mouse is taken from, on the light-space map and on "
      "the object: colour by how much a sample adds, size of its footprint. I.",
      state.inspect.samples);
  drawSamplerError(context);
  const RenderStats* stats = context.view.stats();
  if (!stats) return;
  for (const RenderStats::Pass& pass : stats->passes) {
    std::string name = pass.name;
    std::replace(name.begin(), name.end(), '_', ' ');
    context.ui.label(name.c_str(), "Device time of the newest frame that drew it.");
    ImGui::Text(pass.runs > 0 ? "%.1f ms" : "kept", pass.gpuMs);
  }
  context.ui.note(fmt::format("{} triangles; maps {:.1f} MB, device {:.0f} MB\n{}", stats->triangles,
                              double(stats->mapBytes) / 1e6, double(stats->gpuBytes) / 1e6, stats->device));
  const auto& times = context.controls.frameMs;
  if (times.empty()) return;
  context.ui.label("Frames, ms",
                   "Of the last frames that drew; the picture is drawn coarser when they take too long.");
  const float longest = *std::max_element(times.begin(), times.end());
  const std::string scale = fmt::format("last {:.0f}, longest {:.0f}", times.back(), longest);
  ImGui::PlotHistogram("##frames", times.data(), int(times.size()), 0, scale.c_str(), 0, 1.6f * longest,
                       {0, float(40 * context.ui.scale())});
}

}  // namespace lychnite::viewer
