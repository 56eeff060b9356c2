// Fig. 1: the same shape in two sizes, ten times apart, one parallel light.
#include <fmt/format.h>

#include "app/paper/parts.h"
#include "lychnite/base/units.h"
#include "lychnite/optics/materials.h"

namespace lychnite::paper {
namespace {

constexpr double kSmall = 10, kLarge = 100;  // mm
constexpr ParallelLight kLight{.azimuth = 130, .elevation = 30};

RenderSettings settingsOf(const Studio& studio) {
  RenderSettings settings;
  settings.width = settings.height = studio.quick() ? 200 : 600;
  settings.multipleSamples = 64;
  return settings;
}

Scene sceneOf(Studio& studio, double size) {
  Scene scene;
  scene.objects = {studio.object("figurine")};
  scene.objects[0].material.medium = findMaterial("marble", "paper").coefficients;
  scene.objects[0].size = size;
  scene.lights = {kLight};
  return scene;
}

/// Both at their true sizes: the small one stands before the large one's foot.
Scene together(Studio& studio) {
  Scene scene = sceneOf(studio, kLarge);
  Object small = scene.objects[0];
  small.size = kSmall;
  small.position = {0.45 * kLarge, -0.5 * kLarge + 0.5 * kSmall, 0.2 * kLarge};
  scene.objects.push_back(small);
  return scene;
}

}  // namespace

int sizesSteps(const Studio&) {
  return 3;
}

void makeSizes(Studio& studio, Report& report) {
  const RenderSettings settings = settingsOf(studio);
  const Image small = studio.picture("small", sceneOf(studio, kSmall), settings);
  const Image large = studio.picture("large", sceneOf(studio, kLarge), settings);
  const Image both = studio.picture("together", together(studio), settings);
  const ToneMapping tone{.exposure = exposureFor(small)};
  Gallery gallery{.columns = 3};
  for (const auto& [name, image, label] :
       {std::tuple("small", &small, formatLength(kSmall)), std::tuple("large", &large, formatLength(kLarge)),
        std::tuple("together", &both, std::string("both, true to scale"))})
    gallery.pictures.push_back({studio.show(name, *image, tone), fmt::format("{}.exr", name), label, ""});
  gallery.caption = fmt::format(
      "A marble knight of {} and of {}, the camera's distance in proportion, the same parallel light from "
      "behind "
      "(azimuth {:g}, elevation {:g} degrees) and the same exposure ({:+.2f} stops). Light goes through the "
      "small one "
      "and stays near the surface of the large one. By `matched`, 64 samples.",
      formatLength(kSmall), formatLength(kLarge), kLight.azimuth, kLight.elevation, tone.exposure);
  report.blocks.push_back(gallery);
  Table table{
      .name = "brightness",
      .caption = "Mean radiance over the covered pixels, for irradiance pi on a surface facing the light.",
      .columns = {{"size", "size_mm", 0}, {"red", "red", 4}, {"green", "green", 4}, {"blue", "blue", 4}}};
  for (const auto& [size, image] : {std::pair(kSmall, &small), std::pair(kLarge, &large)}) {
    const glm::dvec3 mean = meanColour(*image);
    table.rows.push_back({size, mean.x, mean.y, mean.z});
  }
  table.columns[0].name = "size, mm";
  report.blocks.push_back(table);
  report.differs =
      "The paper does not state its model's size, its material or its light's direction; shape, material and "
      "light "
      "are ours. The third picture has no counterpart there.";
}

}  // namespace lychnite::paper
