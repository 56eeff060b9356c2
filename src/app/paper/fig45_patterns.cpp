// Fig. 4 and 5: the part of the map that the samples cover at several sizes, and the patterns with their
// levels, drawn over the real map.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/paper/canvas.h"
#include "app/paper/light_space.h"
#include "app/paper/parts.h"
#include "lychnite/base/atomic_file.h"
#include "lychnite/base/units.h"
#include "lychnite/optics/materials.h"

namespace lychnite::paper {
namespace {

constexpr double kSizes[] = {1, 10, 100};  // mm
constexpr int kSpiralSamples = 48;
constexpr ParallelLight kLight{.azimuth = 60, .elevation = 30};
constexpr const char* kMaterial = "fig6";
constexpr int kReceivers = 24;    // pixels along a side of the picture whose samples are looked at
constexpr double kPicture = 320;  // points

Scene sceneOf(Studio& studio, double size) {
  Scene scene;
  scene.objects = {studio.object("figurine")};
  scene.objects[0].material.medium = findMaterial(kMaterial, "paper").coefficients;
  scene.objects[0].size = size;
  scene.lights = {kLight};
  return scene;
}

constexpr Method kMethods[] = {Method::kFixed, Method::kAdaptive, Method::kMatched};

RenderSettings settingsOf(Method method, int mapSize) {
  RenderSettings settings;
  settings.method = method;
  settings.width = settings.height = kReceivers;
  settings.mapSize = settings.mostMapSize = mapSize;
  settings.multipleSamples = kSpiralSamples;
  settings.components = {.multiple = true, .single = false, .surface = false};
  return settings;
}

/// Darker for coarser levels; the widths differ, too.
Stroke strokeOf(double level) {
  const float t = float(std::clamp(level / 6, 0.0, 1.0));
  return {.colour = {0.85f - 0.75f * t, 0.25f * (1 - t), 0.05f + 0.5f * t}, .width = 0.6 + 0.9 * double(t)};
}

/// The whole map, or a part of it around the receiver `zoom` times as large.
void draw(const FluxMap& map, const Receiver& receiver, double zoom, const std::filesystem::path& path) {
  writeAtomically(path, [&](const std::filesystem::path& temporary) {
    Canvas canvas(temporary, kPicture, kPicture);
    const double scale = kPicture / map.size() * zoom;
    const glm::dvec2 corner =
        zoom > 1 ? glm::dvec2(receiver.place.x, map.size() - receiver.place.y) - 0.5 * kPicture / scale
                 : glm::dvec2(0);
    const auto onPage = [&](const glm::dvec2& p) {
      return (glm::dvec2(p.x, map.size() - p.y) - corner) * scale;
    };
    canvas.clip({0, 0}, {kPicture, kPicture});
    canvas.picture(map.picture(), -corner * scale, glm::dvec2(map.size() * scale));
    for (const Sample& sample : receiver.samples) {
      const double side = std::sqrt(sample.area) * scale;
      canvas.rectangle(onPage(sample.place) - glm::dvec2(side / 2), glm::dvec2(side), strokeOf(sample.level));
      canvas.filledRectangle(onPage(sample.place) - glm::dvec2(0.9), glm::dvec2(1.8),
                             strokeOf(sample.level).colour);
    }
    canvas.marker(Marker::kCross, onPage(receiver.place), 9, glm::vec3(0));
    canvas.unclip();
    canvas.rectangle({0.5, 0.5}, {kPicture - 1, kPicture - 1}, {.width = 0.8});
    canvas.finish();
  });
}

/// The one nearest to a little off the map's middle.
const Receiver& shownReceiver(const FluxMap& map, const std::vector<Receiver>& receivers) {
  const glm::dvec2 wanted = glm::dvec2(0.53, 0.42) * double(map.size());
  return *std::min_element(receivers.begin(), receivers.end(), [&](const Receiver& a, const Receiver& b) {
    return glm::distance(a.place, wanted) < glm::distance(b.place, wanted);
  });
}

std::string levelsText(const std::vector<Sample>& samples) {
  double low = 100, high = 0;
  for (const Sample& sample : samples) {
    low = std::min(low, sample.level);
    high = std::max(high, sample.level);
  }
  return fmt::format("levels {:.2g} to {:.2g}", low, high);
}

Coverage meanCoverage(const FluxMap& map, const std::vector<Receiver>& receivers) {
  Coverage sum;
  for (const Receiver& receiver : receivers) {
    const Coverage one = coverageOf(map, receiver.samples);
    sum.area += one.area / double(receivers.size());
    sum.flux += one.flux / double(receivers.size());
  }
  return sum;
}

}  // namespace

int patternSteps(const Studio&) {
  return int(std::size(kSizes));
}

void makePatterns(Studio& studio, Report& report) {
  const int mapSize = studio.quick() ? 256 : 512;
  Gallery gallery{.columns = int(std::size(kSizes))};
  Table table{
      .name = "coverage",
      .caption =
          "What the cells of the patterns see of the map, mean over receivers on the lit surface, as the "
          "shaders take them (`matched` takes more where the surface slants): the "
          "share of the lit texels that lie in a cell, and the flux that the cells stand for over all "
          "that enters (100 % loses and invents nothing).",
      .columns = {{"size, mm", "size_mm", 0},
                  {"pattern", "pattern"},
                  {"samples", "samples", 0},
                  {"lit texels covered, %", "covered_area", 1, 100},
                  {"flux, %", "flux", 1, 100}}};
  std::vector<std::vector<Picture>> rows(std::size(kMethods));
  for (const double size : kSizes) {
    const Scene scene = sceneOf(studio, size);
    const FluxMap map(studio.renderer(), scene, mapSize);
    for (size_t m = 0; m < std::size(kMethods); ++m) {
      const std::string name = methodName(kMethods[m]);
      const std::vector<Receiver> receivers =
          receiversOf(studio.renderer(), scene, settingsOf(kMethods[m], mapSize));
      const Receiver& shown = shownReceiver(map, receivers);
      const std::string file = fmt::format("{}-{:g}mm.svg", name, size);
      draw(map, shown, size > 50 ? 4 : 1, studio.file(file));
      rows[m].push_back({file, "",
                         fmt::format("{}, {}{}", name, formatLength(size), size > 50 ? ", 4 times" : ""),
                         levelsText(shown.samples)});
      size_t samples = 0;
      for (const Receiver& receiver : receivers) samples += receiver.samples.size();
      const Coverage coverage = meanCoverage(map, receivers);
      table.rows.push_back(
          {size, name, double(samples) / double(receivers.size()), coverage.area, coverage.flux});
    }
    studio.step(formatLength(size));
  }
  for (std::vector<Picture>& row : rows)
    gallery.pictures.insert(gallery.pictures.end(), row.begin(), row.end());
  gallery.caption = fmt::format(
      "The cells around one receiver (cross) over the light-space map of the figurine in the paper's "
      "material, map {0} x "
      "{0}. A cell is drawn as a square of the area that its sample stands for; colour and line width go by "
      "its mip level "
      "(thin and red: 0; thick and blue: 6 and up). At 10 cm the part around the receiver is shown four "
      "times as large; most of the map lies beyond the profile's reach there, and needs not to be seen.",
      mapSize);
  report.blocks.push_back(gallery);
  report.blocks.push_back(table);
  report.differs =
      "The paper draws its pattern over a sketch; here it lies over the map that the renderer made. Its "
      "constants C1, C2 "
      "and K are not printed; ours are fitted (docs/sampling.md). `matched` is not in the paper.";
}

}  // namespace lychnite::paper
