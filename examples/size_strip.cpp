// size_strip PICTURE.png MODEL...: each model in marble at 5, 20 and 100 mm, lit from behind and a little
// from the front; one row a model. What ./demo runs, and an example of the library: scene in, picture out.
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "lychnite/app/image_maker.h"
#include "lychnite/base/error.h"
#include "lychnite/image/io.h"
#include "lychnite/image/montage.h"
#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene_file.h"

namespace {

using namespace lychnite;

constexpr std::array kSizes{5.0, 20.0, 100.0};  // mm

Scene sceneOf(const Object& object) {
  Scene scene;
  scene.objects = {object};
  scene.lights = {ParallelLight{.azimuth = 140, .elevation = 30, .irradiance = Rgb(6)},
                  ParallelLight{.azimuth = -50, .elevation = 35, .irradiance = Rgb(0.5)}};
  scene.camera = OrbitCamera{.azimuth = 0, .elevation = 8};
  scene.background = Rgb(0.01);
  return scene;
}

std::string nameOf(const std::string& model) {
  const size_t slash = model.find_last_of('/');
  return slash == std::string::npos ? model : model.substr(slash + 1);
}

void warn(LogLevel level, std::string_view message) {
  if (level == LogLevel::kWarning) std::fprintf(stderr, "%.*s\n", int(message.size()), message.data());
}

void drawStrip(const std::string& path, const std::vector<std::string>& models) {
  std::vector<Object> objects;  // all of them first, so that a bad file is said before the work
  for (const std::string& model : models) {
    objects.push_back(loadObject(model, ".", warn));
    objects.back().material.medium = findMaterial("marble", "material").coefficients;
  }
  RenderSettings settings;
  settings.width = settings.height = 480;
  ImageMaker maker({.log = warn});
  std::vector<Image> pictures;
  for (const Object& object : objects) {
    Scene scene = sceneOf(object);
    for (const double size : kSizes) {
      scene.objects.front().size = size;
      pictures.push_back(maker.render(scene, settings));
    }
  }
  std::vector<Panel> panels;
  for (size_t i = 0; i < pictures.size(); ++i)
    panels.push_back({.image = &pictures[i],
                      .label = nameOf(models[i / kSizes.size()]) + ", marble, " +
                               std::to_string(int(kSizes[i % kSizes.size()])) + " mm"});
  writePng(montage(panels, ToneMapping{.curve = ToneMapping::Curve::kFilmic, .exposure = 1}, kSizes.size()),
           path);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "size_strip: expected PICTURE.png MODEL...\n");
    return 2;
  }
  try {
    drawStrip(argv[1], {argv + 2, argv + argc});
    std::printf("picture: %s\n", argv[1]);
    return 0;
  } catch (const Error& error) {
    std::fprintf(stderr, "size_strip: %s\n", error.what());
    return error.kind() == Error::Kind::kDevice ? 3 : 1;
  }
}
