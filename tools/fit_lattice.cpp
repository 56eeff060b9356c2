// Fits the paper's constants C1 and C2 (K = 1, see LatticeConstants) against the dipole judge: the pair with
// the smallest mean relative RMSE of the multiple-scattering component over the sizes, materials, models and
// lights below, and prints the whole grid so that the choice can be seen. Takes some minutes: fit_lattice >
// docs/data/lattice-fit.txt
#include <fmt/format.h>

#include <vector>

#include "lychnite/app/image_maker.h"
#include "lychnite/image/metrics.h"
#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene_file.h"

namespace {

using namespace lychnite;

struct Case {
  Scene scene;
  Image reference;
};

constexpr double kSizes[] = {1, 3, 10, 30, 100, 300};
constexpr const char* kMaterials[] = {"fig6", "marble", "skin1", "wholemilk"};
constexpr const char* kModels[] = {"sphere", "figurine", "stone"};
constexpr ParallelLight kLights[] = {{.azimuth = -30, .elevation = 40}, {.azimuth = 150, .elevation = 25}};

RenderSettings settingsOf(Method method) {
  RenderSettings settings;
  settings.width = settings.height = 96;
  settings.method = method;
  settings.tolerance = 0.01;
  settings.components = {.multiple = true, .single = false, .surface = false};
  return settings;
}

std::vector<Case> makeCases(ImageMaker& maker) {
  std::vector<Case> cases;
  for (const char* model : kModels)
    for (const char* material : kMaterials)
      for (const double size : kSizes)
        for (const ParallelLight& light : kLights) {
          Scene scene;
          scene.objects.push_back(loadObject(model));
          scene.objects[0].size = size;
          scene.objects[0].material.name = material;
          scene.objects[0].material.medium = findMaterial(material, "").coefficients;
          scene.lights = {light};
          cases.push_back({scene, maker.render(scene, settingsOf(Method::kDipole))});
          fmt::print(stderr, "\rreferences {}/144", cases.size());
        }
  return cases;
}

struct Score {
  double asItIs = 0, afterGain = 0;
};

Score score(ImageMaker& maker, const std::vector<Case>& cases, const LatticeConstants& constants) {
  RenderSettings settings = settingsOf(Method::kAdaptive);
  settings.lattice = constants;
  Score sum;
  for (const Case& c : cases) {
    const Metrics m = compare(maker.render(c.scene, settings), c.reference).together;
    sum.asItIs += m.relative_rmse / double(cases.size());
    sum.afterGain += m.relative_rmse_after_gain / double(cases.size());
  }
  return sum;
}

}  // namespace

int main() {
  ImageMaker maker({});
  const std::vector<Case> cases = makeCases(maker);
  fmt::print(
      "# sizes 1 3 10 30 100 300 mm; fig6 marble skin1 wholemilk; sphere figurine stone; lights -30,40 and "
      "150,25; "
      "512 map, 96 x 96\n# C1 C2 mean relative RMSE (as it is, after one best gain per picture)\n");
  LatticeConstants best;
  double bestError = 1e9;
  for (double C1 = 0.25; C1 < 3.6; C1 += 0.25) {
    for (double C2 = 0; C2 < 0.76; C2 += 0.125) {
      const Score s = score(maker, cases, {C1, C2, 1});
      fmt::print("{:.3f} {:.3f} {:.4f} {:.4f}\n", C1, C2, s.asItIs, s.afterGain);
      std::fflush(stdout);
      if (s.asItIs >= bestError) continue;
      bestError = s.asItIs;
      best = {C1, C2, 1};
    }
  }
  fmt::print("# best: C1 {:.3f} C2 {:.3f} K 1, mean relative RMSE {:.4f}\n", best.C1, best.C2, bestError);
}
