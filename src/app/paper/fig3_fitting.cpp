// Fig. 3: what becomes of a small object in a map that is not fitted to it, and the cure.
#include <fmt/format.h>

#include <cmath>

#include "app/paper/light_space.h"
#include "app/paper/parts.h"
#include "lychnite/image/metrics.h"
#include "lychnite/optics/materials.h"

namespace lychnite::paper {
namespace {

constexpr double kSize = 10, kTimes = 16;  // mm; the window is made for an object that many times as large
constexpr ParallelLight kLight{.azimuth = 75, .elevation = 35};

RenderSettings settingsOf(const Studio& studio, Method method) {
  RenderSettings settings;
  settings.width = studio.quick() ? 120 : 360;
  settings.height = studio.quick() ? 160 : 480;
  settings.method = method;
  settings.mapSize = settings.mostMapSize = 256;
  return settings;
}

Scene fitted(Studio& studio) {
  Scene scene;
  scene.objects = {studio.object("figurine")};
  scene.objects[0].material.medium = findMaterial("fig6", "paper").coefficients;
  scene.objects[0].size = kSize;
  scene.lights = {kLight};
  scene.camera = OrbitCamera{.factor = 0.8};
  return scene;
}

/// The same object at the same place with two specks far to either side, which the map has to hold, too.
Scene unfitted(Studio& studio, const RenderSettings& settings) {
  Scene scene = fitted(studio);
  const CameraFrame camera = cameraFrame(scene, settings.width, settings.height);
  Object& object = scene.objects[0];
  const Bounds box = boundsOf(*object.mesh);
  auto mesh = std::make_shared<Mesh>(*object.mesh);
  const double half = 0.5 * kTimes * box.longestSide();
  for (const double side : {-1.0, 1.0}) {
    const auto first = uint32_t(mesh->positions.size());
    const glm::vec3 at(box.centre() + glm::dvec3(side * half, 0, 0));
    const float speck = float(1e-4 * box.longestSide());
    for (const glm::vec3& corner :
         {glm::vec3(0), glm::vec3(-float(side) * speck, 0, 0), glm::vec3(0, speck, 0)}) {
      mesh->positions.push_back(at + corner);
      mesh->normals.emplace_back(0, 0, 1);
    }
    mesh->triangles.emplace_back(first, first + 1, first + 2);
  }
  mesh->extent.reset();
  mesh->extent = extentOf(*mesh);
  object.mesh = mesh;
  object.size = kSize * kTimes;
  scene.camera = PinholeCamera{.position = camera.position,
                               .target = camera.position + camera.forward * kSize,
                               .up = camera.up,
                               .fov = 2 * std::atan(camera.tanHalfFovY) * 180 / 3.14159265358979323846};
  return scene;
}

}  // namespace

int fittingSteps(const Studio&) {
  return 6;
}

void makeFitting(Studio& studio, Report& report) {
  const RenderSettings judge = settingsOf(studio, Method::kHierarchical);
  const Scene good = fitted(studio), bad = unfitted(studio, judge);
  const Image reference = studio.picture("hierarchical", good, judge);
  const ToneMapping tone{.exposure = exposureFor(reference)};
  Gallery gallery{.columns = 5};
  Table table{
      .name = "errors",
      .caption =
          "Against the hierarchical method, which sums the same profile without a map: the error of map and "
          "sampler alone.",
      .columns = {{"method", "method"},
                  {"map", "map"},
                  {"texel, mm", "texel_mm", 3},
                  {"RMSE, %", "relative_rmse", 1, 100},
                  {"RMSE after gain, %", "relative_rmse_after_gain", 1, 100}}};
  const FluxMap small(studio.renderer(), bad, judge.mapSize), full(studio.renderer(), good, judge.mapSize);
  studio.step("maps");
  std::vector<Image> pictures;
  for (const Method method : {Method::kAdaptive, Method::kMatched})
    for (const bool isFitted : {false, true}) {
      RenderSettings settings = settingsOf(studio, method);
      // The object's true size is what eq. 4 asks for, whatever the window's.
      if (!isFitted) settings.lattice.C1 += settings.lattice.C2 * std::log2(kTimes);
      const std::string name = methodName(method) + (isFitted ? "-fitted" : "-unfitted");
      const Image image = studio.picture(name, isFitted ? good : bad, settings);
      gallery.pictures.push_back(
          {studio.show(name, image, tone), name + ".exr",
           fmt::format("{}, {}", methodName(method), isFitted ? "fitted" : "not fitted"), ""});
      const Metrics error = compare(image, reference).together;
      table.rows.push_back({methodName(method), isFitted ? "fitted" : "not fitted",
                            (isFitted ? full : small).texel(), error.relative_rmse,
                            error.relative_rmse_after_gain});
    }
  gallery.pictures.push_back(
      {studio.show("hierarchical", reference, tone), "hierarchical.exr", "hierarchical", ""});
  for (const auto& [name, map] : {std::pair("map-unfitted", &small), std::pair("map-fitted", &full)})
    gallery.pictures.push_back({studio.show(name, displayed(map->picture())), "",
                                map == &small ? "the map, not fitted" : "the map, fitted",
                                "as the light sees it"});
  gallery.caption = fmt::format(
      "A knight of {0:g} mm in the paper's material. Not fitted: the map's window ({1} x {1} texels) is made "
      "for {2:g} mm, "
      "and few texels are left for the object. Fitted: the window follows the object (the paper's k_s), as "
      "it always does "
      "in Lychnite. One exposure ({3:+.2f} stops).",
      kSize, judge.mapSize, kSize * kTimes, tone.exposure);
  report.blocks.push_back(gallery);
  report.blocks.push_back(table);
  report.differs =
      "Lychnite cannot leave a map unfitted: two specks far off to either side of the object, out of the "
      "picture, widen "
      "its window here.";
}

}  // namespace lychnite::paper
