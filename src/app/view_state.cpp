#include "lychnite/app/view_state.h"

#include <fmt/format.h>

#include <algorithm>

#include "lychnite/app/sweep.h"
#include "lychnite/base/units.h"
#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene_file.h"

namespace lychnite {
namespace {

/// What sceneToToml leaves out of a material: an opaque one's medium is not written when it has no name.
std::string materialKey(const Material& material) {
  const Coefficients& m = material.medium;
  return fmt::format("{} {} {} {} {} {} {} {} {} {}", material.name, m.sigma_s.x, m.sigma_s.y, m.sigma_s.z,
                     m.sigma_a.x, m.sigma_a.y, m.sigma_a.z, m.g, m.eta, material.roughness);
}

std::string settingsKey(const RenderSettings& s) {
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {}", methodName(s.method),
                     profileName(s.profile), componentsName(s.components), s.multipleSamples, s.lattice.C1,
                     s.lattice.C2, s.lattice.K, s.singleSamples, s.mapSize, s.mostMapSize, s.seed, s.samples,
                     s.cells, s.collisions);
}

std::string variantKey(const Variant& v) {
  return fmt::format("{} {} {} {} {}", v.method ? methodName(*v.method) : "-", v.samples.value_or(0),
                     v.profile ? profileName(*v.profile) : "-", v.material ? materialKey(*v.material) : "-",
                     v.size.value_or(0));
}

/// `text` as one word of a POSIX shell.
std::string shellWord(const std::string& text) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("._-/,:=%+").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

size_t subjectIndex(const Scene& scene) {
  for (size_t i = 0; i < scene.objects.size(); ++i)
    if (!scene.objects[i].material.opaque) return i;
  return 0;
}

std::string fingerprint(const ViewState& state) {
  std::string text = sceneToToml(state.scene);
  for (const Object& object : state.scene.objects)
    text += fmt::format("{} {}\n", fmt::ptr(object.mesh.get()), materialKey(object.material));
  const CompareView& c = state.compare;
  text += settingsKey(state.settings);
  text += fmt::format("\n{} {}\n", toneCurveName(state.toneMapping.curve), state.toneMapping.exposure);
  text += variantKey(state.variant);
  text += fmt::format("\n{} {} {} {} {}\n", int(c.mode), int(c.left), int(c.right), c.wipe, c.full);
  text += fmt::format("{} {} {} {} {} {}\n", int(state.inspect.layer), state.inspect.light,
                      state.inspect.mapLevel, state.inspect.samples, state.ruler, state.resolution);
  return text;
}

ViewState applied(const Variant& variant, const ViewState& state) {
  ViewState result = state;
  if (variant.method) result.settings.method = *variant.method;
  if (variant.samples) result.settings.multipleSamples = *variant.samples;
  if (variant.profile) result.settings.profile = *variant.profile;
  if (result.scene.objects.empty()) return result;
  const size_t subject = subjectIndex(result.scene);
  if (variant.material) result.scene.objects[subject].material = *variant.material;
  if (variant.size)
    result.scene = scaledScene(result.scene, *variant.size / result.scene.objects[subject].size);
  return result;
}

ViewState defaultView(const Object& object) {
  ViewState state;
  state.scene.objects.push_back(object);
  Object& subject = state.scene.objects.front();
  subject.size = 30;
  subject.material.name = "marble";
  subject.material.medium = findMaterial("marble", "material").coefficients;
  state.scene.lights = {ParallelLight{.azimuth = 150, .elevation = 35, .irradiance = Rgb(3.4, 3.1, 2.8)},
                        ParallelLight{.azimuth = -50, .elevation = 30, .irradiance = Rgb(0.38, 0.45, 0.55)}};
  state.scene.camera = OrbitCamera{.azimuth = 8, .elevation = 9, .factor = 1.15};
  state.scene.background = Rgb(0.012, 0.012, 0.013);
  state.scene.ambient = Rgb(0.02, 0.02, 0.022);
  return state;
}

std::string renderCommand(const ViewState& state, const std::string& scenePath,
                          const std::string& picturePath, int width, int height) {
  const RenderSettings& s = state.settings;
  const RenderSettings usual;
  std::string text =
      fmt::format("lychnite render {} --resolution {}x{}", shellWord(scenePath), width, height);
  const auto add = [&](bool wanted, const std::string& flag) {
    if (wanted) text += " " + flag;
  };
  add(s.method != usual.method, "--method " + methodName(s.method));
  add(s.profile != usual.profile, "--profile " + profileName(s.profile));
  add(componentsName(s.components) != componentsName(usual.components),
      "--components " + componentsName(s.components));
  add(s.method == Method::kMatched && s.multipleSamples != usual.multipleSamples,
      fmt::format("--samples {}", s.multipleSamples));
  add(s.singleSamples != usual.singleSamples, fmt::format("--single-samples {}", s.singleSamples));
  add(s.mostMapSize == s.mapSize, fmt::format("--map {}", s.mapSize));
  add(s.method == Method::kVolume && s.cells != usual.cells, fmt::format("--cells {}", s.cells));
  add(s.method == Method::kVolume && s.collisions != usual.collisions,
      fmt::format("--collisions {}", s.collisions));
  add(state.toneMapping.exposure != 0, fmt::format("--exposure {}", state.toneMapping.exposure));
  add(state.toneMapping.curve != ToneMapping::Curve::kSrgb,
      "--tone-map " + toneCurveName(state.toneMapping.curve));
  return text + " -o " + shellWord(picturePath);
}

}  // namespace lychnite
