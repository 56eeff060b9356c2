#include "lychnite/scene/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lychnite/base/error.h"
#include "lychnite/base/text.h"

namespace lychnite {
namespace {

const std::vector<std::string>& methodNames() {
  static const std::vector<std::string> names{"matched",      "adaptive", "fixed", "dipole",
                                              "hierarchical", "walk",     "volume"};
  return names;
}

[[noreturn]] void refuse(std::string_view where, std::string expected, std::string found,
                         std::string todo = "") {
  throw Error({.where = std::string(where),
               .expected = std::move(expected),
               .found = std::move(found),
               .todo = std::move(todo)},
              Error::Kind::kUsage);
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string suggestion(std::string_view name, const std::vector<std::string>& names) {
  const std::string nearest = nearestName(name, names);
  return nearest.empty() ? "" : fmt::format("did you mean '{}'?", nearest);
}

void requireRange(double value, double low, double high, std::string_view where) {
  if (!(value >= low && value <= high))
    refuse(where, fmt::format("a number from {} to {}", low, high), fmt::format("{}", value));
}

}  // namespace

Method parseMethod(std::string_view name, std::string_view where) {
  const auto& names = methodNames();
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) refuse(where, joined(names), fmt::format("'{}'", name), suggestion(name, names));
  return Method(at - names.begin());
}

std::string methodName(Method method) {
  return method == Method::kAuto ? "auto" : methodNames()[size_t(method)];
}

bool isReference(Method method) {
  return method == Method::kDipole || method == Method::kHierarchical || method == Method::kWalk;
}

Components parseComponents(std::string_view list, std::string_view where) {
  const std::vector<std::string> names{"multiple", "single", "surface"};
  Components result{false, false, false};
  for (const std::string& part : split(list, ',')) {
    if (part == "multiple")
      result.multiple = true;
    else if (part == "single")
      result.single = true;
    else if (part == "surface")
      result.surface = true;
    else
      refuse(where, "a list of multiple, single and surface", fmt::format("'{}'", part),
             suggestion(part, names));
  }
  return result;
}

std::string componentsName(const Components& components) {
  std::vector<std::string> parts;
  if (components.multiple) parts.push_back("multiple");
  if (components.single) parts.push_back("single");
  if (components.surface) parts.push_back("surface");
  return fmt::format("{}", fmt::join(parts, ","));
}

bool RenderSettings::wants(std::string_view aov) const {
  return std::find(aovs.begin(), aovs.end(), aov) != aovs.end();
}

Method resolved(const RenderSettings& settings) {
  if (settings.method != Method::kAuto) return settings.method;
  return settings.wants("lights") ? Method::kMatched : Method::kVolume;
}

void validate(const RenderSettings& settings) {
  if (settings.width < 1 || settings.height < 1 || settings.width > 16384 || settings.height > 16384)
    refuse("resolution", "WxH with both from 1 to 16384",
           fmt::format("{}x{}", settings.width, settings.height));
  if (settings.mapSize < 128 || settings.mapSize > 4096)
    refuse("map", "a size from 128 to 4096 texels", fmt::format("{}", settings.mapSize));
  if (settings.mostMapSize > 4096)
    refuse("map", "at most 4096 texels", fmt::format("up to {}", settings.mostMapSize));
  requireRange(settings.multipleSamples, 8, 128, "multiple samples");
  requireRange(settings.interpolation, 0, 1, "interpolation");
  requireRange(settings.singleSamples, 1, 256, "single samples");
  requireRange(settings.samples, 1e-3, 1e9, "samples");
  requireRange(settings.tolerance, 1e-5, 1, "tolerance");
  requireRange(settings.timeLimit, 0, 1e9, "time");
  requireRange(settings.noise, 0, 10, "noise");
  if (settings.cells != 0) requireRange(settings.cells, 8, 192, "cells");
  requireRange(settings.collisions, 1, 64, "collisions");
  requireRange(settings.passes, 1, 10000, "passes");
  requireRange(settings.threads, 0, 1024, "threads");
  const std::vector<std::string> known{"multiple", "single", "surface",   "depth",
                                       "normal",   "lights", "radiosity", "stderr"};
  for (const std::string& aov : settings.aovs) {
    if (std::find(known.begin(), known.end(), aov) == known.end())
      refuse("aov", joined(known), fmt::format("'{}'", aov), suggestion(aov, known));
    const Method method = resolved(settings);
    if (aov == "stderr" && method != Method::kWalk && method != Method::kVolume)
      refuse("aov", "a method with noise (walk, volume) for 'stderr'",
             fmt::format("'{}'", methodName(method)));
    if (aov == "lights" && (isReference(method) || method == Method::kVolume))
      refuse("aov", "a real-time method for 'lights'", fmt::format("'{}'", methodName(method)));
  }
}

}  // namespace lychnite
