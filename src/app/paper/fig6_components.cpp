// Fig. 6: single, multiple and full scattering, and diffuse shading, in the paper's material.
#include <fmt/format.h>

#include "app/paper/parts.h"
#include "lychnite/optics/materials.h"
#include "lychnite/optics/profile.h"

namespace lychnite::paper {
namespace {

constexpr ParallelLight kLight{.azimuth = 75, .elevation = 35};
constexpr double kSize = 10;  // mm

struct View {
  const char *name, *label;
  Components components;
  bool opaque = false;
};
constexpr View kViews[] = {{"single", "single scattering", {false, true, false}},
                           {"multiple", "multiple scattering", {true, false, false}},
                           {"full", "single + multiple + surface", {true, true, true}},
                           {"diffuse", "diffuse shading of the same colour", {true, true, true}, true}};

Scene sceneOf(Studio& studio, bool opaque) {
  Scene scene;
  scene.objects = {studio.object("figurine")};
  Material& material = scene.objects[0].material;
  material.medium = findMaterial("fig6", "paper").coefficients;
  material.opaque = opaque;
  material.colour = makeDipole(material.medium)->P(0);
  scene.objects[0].size = kSize;
  scene.lights = {kLight};
  return scene;
}

}  // namespace

int componentsSteps(const Studio&) {
  return int(std::size(kViews));
}

void makeComponents(Studio& studio, Report& report) {
  RenderSettings settings;
  settings.width = settings.height = studio.quick() ? 160 : 480;
  settings.multipleSamples = 64;
  settings.singleSamples = 16;
  std::vector<Image> images;
  for (const View& view : kViews) {
    settings.components = view.components;
    images.push_back(studio.picture(view.name, sceneOf(studio, view.opaque), settings));
  }
  const ToneMapping tone{.exposure = exposureFor(images[2])};
  Gallery gallery{.columns = int(std::size(kViews))};
  Table table{
      .name = "components",
      .caption = "Mean radiance over the covered pixels.",
      .columns = {{"picture", "picture"}, {"red", "red", 4}, {"green", "green", 4}, {"blue", "blue", 4}}};
  for (size_t v = 0; v < images.size(); ++v) {
    const View& view = kViews[v];
    gallery.pictures.push_back(
        {studio.show(view.name, images[v], tone), fmt::format("{}.exr", view.name), view.label, ""});
    const glm::dvec3 mean = meanColour(images[v]);
    table.rows.push_back({view.label, mean.x, mean.y, mean.z});
  }
  gallery.caption = fmt::format(
      "The paper's material (sigma_s 1.63, 2.41, 3.44, sigma_a 0.0125, 0.0206, 0.0487 per mm, eta 1.3, g 0) "
      "at {:g} mm, "
      "parallel light from the side (azimuth {:g}, elevation {:g}), one exposure ({:+.2f} stops), by "
      "`matched` with 64 "
      "samples and 16 along the refracted ray. Diffuse shading is an opaque body of the colour that the "
      "half-space of "
      "the material has, under the same coat.",
      kSize, kLight.azimuth, kLight.elevation, tone.exposure);
  report.blocks.push_back(gallery);
  report.blocks.push_back(table);
  report.differs =
      "The coefficients are the paper's, the shape, size and light ours. `multiple` holds the dipole's whole "
      "radiosity "
      "(all orders), as in the paper, so the full picture counts first-order light in part twice.";
}

}  // namespace lychnite::paper
