// Makes the tables of docs/sampling.md: relative RMSE of the multiple-scattering component of the light-space
// samplers against the dipole judge, as it is and after one best overall gain, over six sizes and four
// materials. Usage: sampling_table MODEL... > table.md   (built-in names or files; some minutes a model)
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "lychnite/app/image_maker.h"
#include "lychnite/base/error.h"
#include "lychnite/image/metrics.h"
#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene_file.h"

namespace {

using namespace lychnite;

constexpr double kSizes[] = {1, 3, 10, 30, 100, 300};
constexpr const char* kMaterials[] = {"fig6", "marble", "skin1", "wholemilk"};
struct NamedLight {
  const char* name;
  ParallelLight light;
};
constexpr NamedLight kLights[] = {{"front (-30, 40)", {.azimuth = -30, .elevation = 40}},
                                  {"behind (150, 25)", {.azimuth = 150, .elevation = 25}}};

struct Row {
  const char* name;
  Method method;
  int samples;
};
constexpr Row kRows[] = {{"adaptive", Method::kAdaptive, 32},
                         {"fixed", Method::kFixed, 32},
                         {"matched, 32", Method::kMatched, 32},
                         {"matched, 96", Method::kMatched, 96}};

RenderSettings settingsOf(Method method, int samples) {
  RenderSettings settings;
  settings.width = settings.height = 96;
  settings.method = method;
  settings.multipleSamples = samples;
  settings.tolerance = 0.01;
  settings.components = {.multiple = true, .single = false, .surface = false};
  return settings;
}

/// Errors of one table row: [material][size].
struct Errors {
  Metrics cells[4][6];
};

Scene sceneOf(const Object& object, const char* material, double size, const ParallelLight& light) {
  Scene scene;
  scene.objects = {object};
  scene.objects[0].size = size;
  scene.objects[0].material.medium = findMaterial(material, "").coefficients;
  scene.lights = {light};
  return scene;
}

void printRow(const char* name, const Errors& errors, bool gain) {
  fmt::print("| {} |", name);
  double sum = 0, worst = 0;
  for (int s = 0; s < 6; ++s) {
    double mean = 0;
    for (const auto& material : errors.cells) {
      const double e = gain ? material[s].relative_rmse_after_gain : material[s].relative_rmse;
      mean += e / 4;
      worst = std::max(worst, e);
    }
    sum += mean / 6;
    fmt::print(" {:.1f} |", mean * 100);
  }
  fmt::print(" {:.1f} | {:.1f} |\n", sum * 100, worst * 100);
}

void printTable(const char* title, const std::vector<Errors>& rows, bool gain) {
  fmt::print(
      "\n{}\n\n| method | 1 mm | 3 mm | 10 mm | 30 mm | 100 mm | 300 mm | mean | worst cell |\n"
      "|-|-|-|-|-|-|-|-|-|\n",
      title);
  for (size_t r = 0; r < rows.size(); ++r) printRow(kRows[r].name, rows[r], gain);
}

void measure(ImageMaker& maker, const std::string& model, const NamedLight& light) {
  const Object object = loadObject(model);
  std::vector<Errors> rows(std::size(kRows));
  for (size_t m = 0; m < 4; ++m)
    for (size_t s = 0; s < 6; ++s) {
      const Scene scene = sceneOf(object, kMaterials[m], kSizes[s], light.light);
      const Image reference = maker.render(scene, settingsOf(Method::kDipole, 32));
      for (size_t r = 0; r < rows.size(); ++r)
        rows[r].cells[m][s] =
            compare(maker.render(scene, settingsOf(kRows[r].method, kRows[r].samples)), reference).together;
      fmt::print(stderr, "\r{} {} {}/24   ", model, light.name, m * 6 + s + 1);
    }
  const auto slash = model.find_last_of('/');
  fmt::print("\n### {}, light from {}\n", slash == std::string::npos ? model : model.substr(slash + 1),
             light.name);
  printTable("Relative RMSE in %, as it is (mean over fig6, marble, skin1, wholemilk):", rows, false);
  printTable("After one best gain per picture:", rows, true);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    ImageMaker maker({});
    for (int i = 1; i < argc; ++i)
      for (const NamedLight& light : kLights) measure(maker, argv[i], light);
  } catch (const Error& error) {
    fmt::print(stderr, "sampling_table: {}\n", error.what());
    return 1;
  }
}
