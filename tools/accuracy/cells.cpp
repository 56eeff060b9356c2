#include "cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/mesh/builtin.h"
#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene_file.h"
#include "plate.h"

namespace lychnite::accuracy {

namespace {

struct NamedLight {
  const char* name;
  ParallelLight light;
};
constexpr std::array<NamedLight, 3> kLights{{{"front", {.azimuth = -40, .elevation = 35}},
                                             {"side", {.azimuth = 100, .elevation = 20}},
                                             {"behind", {.azimuth = 150, .elevation = 20}}}};

bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::ranges::find(list, name) != list.end();
}

void requireOf(const std::vector<std::string>& names, const std::vector<std::string>& known,
               const char* flag) {
  for (const std::string& name : names) {
    if (contains(known, name)) continue;
    const std::string nearest = nearestName(name, known);
    throw Error({.where = flag,
                 .expected = fmt::format("some of {}", fmt::join(known, ",")),
                 .found = "'" + name + "'",
                 .todo = nearest.empty() ? "" : fmt::format("did you mean '{}'?", nearest)},
                Error::Kind::kUsage);
  }
}

bool isOfAnisotropicSet(const Cell& cell) {
  return (cell.shape == "sphere" || cell.shape == "figurine" || cell.shape == "bunny_filled") &&
         (cell.material == "fig6" || cell.material == "skin1");
}

/// FNV-1a, whose low bits then go through all of the number.
uint64_t shuffled(const std::string& text) {
  uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ uint64_t(uint8_t(c))) * 0x100000001b3u;
  return (hash ^ (hash >> 32)) * 0x9e3779b97f4a7c15u;
}

}  // namespace

std::string Cell::name() const {
  return fmt::format("{}-{}-{}mm-{}{}", shape, material, size, light, g != 0 ? fmt::format("-g{}", g) : "");
}

const Choice& everything() {
  static const Choice all{
      .shapes = {"sphere", "plate", "figurine", "bunny_filled", "spot", "nefertiti", "knot"},
      .materials = {"fig6", "marble", "skin1", "wholemilk", "skimmilk", "ketchup"},
      .lights = {"front", "side", "behind"},
      .sizes = {1, 3, 10, 30, 100, 300},
      .gs = {0, 0.8}};
  return all;
}

std::vector<Cell> cellsOf(const Choice& choice) {
  requireOf(choice.lights, everything().lights, "--lights");
  for (const std::string& material : choice.materials) findMaterial(material, "--materials");
  std::vector<Cell> cells;
  for (const double g : choice.gs)
    for (const std::string& shape : choice.shapes)
      for (const std::string& material : choice.materials)
        for (const double size : choice.sizes)
          for (const std::string& light : choice.lights) {
            const Cell cell{shape, material, size, light, g};
            if (g == 0 || isOfAnisotropicSet(cell)) cells.push_back(cell);
          }
  std::ranges::sort(cells, {}, [](const Cell& cell) { return std::pair(shuffled(cell.name()), cell); });
  return cells;
}

const Object& Shapes::at(const std::string& name) {
  const auto found = objects_.find(name);
  if (found != objects_.end()) return found->second;
  if (name == "plate") return objects_[name] = {.name = name, .model = name, .mesh = roundedPlate()};
  const std::filesystem::path file = folder_ / (name + ".ply");
  const bool onDisk = !folder_.empty() && std::filesystem::exists(file);
  if (!onDisk && !builtinMesh(name))
    throw Error({.where = "--models",
                 .expected = "a folder with " + name + ".ply",
                 .found = folder_.empty() ? "none" : "'" + folder_.string() + "'",
                 .todo = "give the folder, or leave the shape out by --shapes"},
                Error::Kind::kUsage);
  return objects_[name] = loadObject(onDisk ? file.string() : name);
}

Scene Shapes::sceneOf(const Cell& cell) {
  Scene scene;
  scene.objects = {at(cell.shape)};
  Object& object = scene.objects[0];
  object.size = cell.size;
  object.material.name = cell.material;
  object.material.medium = findMaterial(cell.material, "--materials").coefficients;
  object.material.medium.sigma_s /= 1 - cell.g;
  object.material.medium.g = cell.g;
  const auto named = std::ranges::find(kLights, cell.light, &NamedLight::name);
  scene.lights = {named->light};
  return scene;
}

}  // namespace lychnite::accuracy
