#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "lychnite/base/error.h"
#include "lychnite/mesh/builtin.h"
#include "lychnite/optics/materials.h"
#include "lychnite/reference/reference.h"
#include "lychnite/volume/volume.h"

namespace lychnite {
namespace {

const VolumeSettings kQuick{.cells = 24, .photons = 1 << 15};

Scene sceneOf(const char* material, double azimuth) {
  Scene scene;
  scene.objects.push_back({.mesh = builtinMesh("figurine"), .size = 10});
  scene.objects[0].material.medium = findMaterial(material, "").coefficients;
  scene.lights.push_back(ParallelLight{.azimuth = azimuth, .elevation = 20});
  return scene;
}

RenderSettings settingsOf(int pixels) {
  RenderSettings settings;
  settings.width = settings.height = pixels;
  settings.aovs = {"multiple", "single", "surface", "radiosity"};
  return settings;
}

void expectSame(const Image& a, const Image& b) {
  for (const char* layer : {"", "multiple", "single", "surface", "radiosity"})
    for (size_t i = 0; i < a.pixelCount(); ++i)
      ASSERT_EQ(a.rgb(i, layer), b.rgb(i, layer)) << layer << " " << i;
}

double meanOf(const Image& image, const char* layer) {
  double sum = 0;
  for (size_t i = 0; i < image.pixelCount(); ++i) sum += double(image.rgb(i, layer).g);
  return sum / double(image.pixelCount());
}

TEST(VolumePicture, OfAViewThatIsKeptIsTheSame) {
  VolumeSolver solver;
  solver.update(sceneOf("skin1", 40), kQuick);
  const Image first = solver.picture(settingsOf(48));
  EXPECT_TRUE(solver.keepsView(settingsOf(48)));
  EXPECT_FALSE(solver.keepsView(settingsOf(40)));
  expectSame(solver.picture(settingsOf(48)), first);
  solver.picture(settingsOf(40));
  EXPECT_FALSE(solver.keepsView(settingsOf(48)));
  expectSame(solver.picture(settingsOf(48)), first);
}

TEST(VolumePicture, OfAnotherCameraOrColourIsThatOfAFreshSolver) {
  Scene scene = sceneOf("skin1", 40);
  VolumeSolver solver;
  solver.update(scene, kQuick);
  solver.picture(settingsOf(48));
  const auto check = [&](bool keepsView) {
    solver.update(scene, kQuick);
    EXPECT_EQ(solver.keepsView(settingsOf(48)), keepsView);
    VolumeSolver fresh;
    fresh.update(scene, kQuick);
    expectSame(solver.picture(settingsOf(48)), fresh.picture(settingsOf(48)));
  };
  scene.camera = OrbitCamera{.azimuth = 70};
  check(false);
  std::get<ParallelLight>(scene.lights[0]).irradiance = {1, 2, 3};
  check(true);
}

TEST(VolumePicture, ThatWasInterruptedIsMadeWholeByTheNext) {
  VolumeSolver solver, fresh;
  solver.update(sceneOf("skin1", 40), kQuick);
  fresh.update(sceneOf("skin1", 40), kQuick);
  const Image whole = fresh.picture(settingsOf(96));
  int interrupted = 0;
  for (int most = 0; most < 8; ++most) {
    int asked = 0;
    const Progress impatient([&](const Progress::Update&) { return asked++ < most; });
    try {
      solver.picture(settingsOf(96), impatient);
    } catch (const Interrupted&) {
      ++interrupted;
    }
  }
  EXPECT_GT(interrupted, 4);
  expectSame(solver.picture(settingsOf(96)), whole);
}

TEST(VolumePicture, FollowsLightsMediaIndexAndSize) {
  Scene scene = sceneOf("skin1", 40);
  VolumeSolver solver;
  const auto settings = settingsOf(48);
  const auto check = [&](const char* what, bool keepsView) {
    solver.update(scene, kQuick);
    EXPECT_EQ(solver.keepsView(settings), keepsView) << what;
    VolumeSolver fresh;
    fresh.update(scene, kQuick);
    const Image kept = solver.picture(settings), anew = fresh.picture(settings);
    // The solver begins at what it has; single scattering and surface are found anew.
    for (const char* layer : {"multiple", "radiosity"})
      EXPECT_NEAR(meanOf(kept, layer) / meanOf(anew, layer), 1, 0.01) << what << ", " << layer;
    for (const char* layer : {"single", "surface"})
      EXPECT_NEAR(meanOf(kept, layer) / meanOf(anew, layer), 1, 1e-4) << what << ", " << layer;
  };
  check("first", false);
  scene.lights[0] = ParallelLight{.azimuth = 90, .elevation = 10};
  check("light", true);
  scene.objects[0].material.medium.sigma_s = {1, 2, 3};
  check("medium", true);
  scene.objects[0].material.medium.g = 0.7;
  check("phase function", true);
  scene.objects[0].material.roughness = 0.4;
  check("roughness", true);
  scene.objects[0].size = 25;
  check("size", true);
  scene.objects[0].material.medium.eta = 1.6;
  check("index", false);
  scene.objects[0].rotation = glm::angleAxis(0.5, glm::dvec3(0, 1, 0));
  check("turn", false);
  scene.objects.push_back({.mesh = builtinMesh("sphere"), .size = 8, .position = {14, 0, 0}});
  scene.objects[1].material.medium = findMaterial("marble", "").coefficients;
  check("another object", false);
}

TEST(VolumePicture, APreviewIsNearTheFullOne) {
  for (const double azimuth : {-40.0, 150.0}) {
    VolumeSolver solver;
    solver.update(sceneOf("skin1", azimuth), kQuick);
    const auto settings = settingsOf(160);
    const Image quick = solver.picture(settings, {}, VolumeSolver::Detail::kPreview);
    const Image full = solver.picture(settings);
    double squares = 0, changed = 0;
    for (size_t i = 0; i < full.pixelCount(); ++i) {
      const double d = double(quick.rgb(i, "single").g - full.rgb(i, "single").g);
      squares += d * d;
      changed += d != 0;
      ASSERT_EQ(quick.rgb(i, "multiple"), full.rgb(i, "multiple"));
    }
    const double mean = meanOf(full, "single"), pixels = double(full.pixelCount());
    EXPECT_GT(changed, 0.1 * pixels);
    EXPECT_NEAR(meanOf(quick, "single") / mean, 1, 0.03) << azimuth;
    // Of the mean with the empty pixels; without the neighbours it would be about 1.
    EXPECT_LT(std::sqrt(squares / pixels) / mean, 0.3) << azimuth;
  }
}

/// Brightness along the middle row of a plate of marble, half of which another one shades, over that of the
/// lit half.
std::vector<double> acrossAShadow(double size, VolumeSolver::Detail detail) {
  Scene scene;
  for (const double height : {0.0, 0.3}) {
    scene.objects.push_back({.mesh = builtinMesh("slab"), .size = size, .position = {0, 0, height * size}});
    scene.objects.back().material.medium = findMaterial("marble", "").coefficients;
  }
  scene.objects[1].material.opaque = true;
  scene.objects[1].position.x = size;  // half of the plate lies in its shadow, seen past it from the left
  scene.lights.push_back(ParallelLight{.azimuth = 60, .elevation = 0});
  scene.camera = OrbitCamera{.azimuth = -30, .elevation = 0};
  VolumeSolver solver;
  solver.update(scene, kQuick);
  RenderSettings settings;
  settings.width = settings.height = 192;
  settings.components = {.multiple = true, .single = false, .surface = false};
  const Image image = solver.picture(settings, {}, detail);
  std::vector<double> row;
  for (int x = 0; x < 192; ++x) row.push_back(double(image.rgb(size_t(96 * 192 + x)).g));
  const double most = *std::max_element(row.begin(), row.end());
  for (double& value : row) value /= most;
  return row;
}

TEST(VolumePicture, ShadowsOfLargeObjectsAreSharpAndOfSmallOnesAreNot) {
  const auto pixelsOfTheEdge = [](const std::vector<double>& row) {
    // From the lit half to the dark one: the last bright pixel and the first dark one after it.
    const auto lit = std::find_if(row.rbegin(), row.rend(), [](double v) { return v > 0.8; }).base();
    const auto dark = std::find_if(lit, row.end(), [](double v) { return v < 0.2; });
    EXPECT_NEAR(double(lit - row.begin()), 96, 8);  // on the plate, whose silhouette is farther out
    return int(dark - lit) + 1;
  };
  for (const auto detail : {VolumeSolver::Detail::kFull, VolumeSolver::Detail::kPreview})
    EXPECT_LE(pixelsOfTheEdge(acrossAShadow(20000, detail)), 2);
  const std::vector<double> small = acrossAShadow(60, VolumeSolver::Detail::kFull);
  EXPECT_GE(pixelsOfTheEdge(small), 4);
  double step = 0;  // from the middle of the lit half on
  for (size_t x = 64; x < small.size(); ++x) step = std::max(step, small[x - 1] - small[x]);
  EXPECT_LT(step, 0.25);
}

/// A box of two triangles a side with one normal a corner, the mean of three sides'.
std::shared_ptr<const Mesh> boxOfMeanNormals() {
  auto mesh = std::make_shared<Mesh>();
  for (int i = 0; i < 8; ++i) {
    mesh->positions.emplace_back(i & 1 ? 0.5f : -0.5f, i & 2 ? 0.5f : -0.5f, i & 4 ? 0.5f : -0.5f);
    mesh->normals.push_back(glm::normalize(mesh->positions.back()));
  }
  mesh->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(VolumePicture, ABoxIsFlatWhateverNormalsItsFileHas) {
  Scene scene;
  scene.objects.push_back({.mesh = boxOfMeanNormals(), .size = 20000});
  scene.objects[0].material.medium = findMaterial("marble", "").coefficients;
  scene.lights.push_back(ParallelLight{.azimuth = 20, .elevation = 20});
  scene.camera = OrbitCamera{.azimuth = 0, .elevation = 0};
  VolumeSolver solver;
  solver.update(scene, kQuick);
  const Image image = solver.picture(settingsOf(96));
  double least = 1e30, most = 0;
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    const size_t x = i % 96, y = i / 96;
    if (x < 36 || x > 60 || y < 36 || y > 60) continue;
    least = std::min(least, double(image.rgb(i, "radiosity").g));
    most = std::max(most, double(image.rgb(i, "radiosity").g));
  }
  EXPECT_GT(least, 0);
  EXPECT_LT(most, 1.02 * least);
}

/// Thin plates scatter light forwards through each other: it does not leave them as from a thick body.
TEST(VolumePicture, LightThatMeetsAnotherSurfaceComesAsItLeft) {
  Scene scene;
  for (int i = 0; i < 2; ++i) {
    scene.objects.push_back({.mesh = builtinMesh("slab"), .size = 10, .position = {0, 0, -4.0 * i}});
    scene.objects[size_t(i)].material.medium = {.sigma_s = Rgb(2), .sigma_a = Rgb(0.3), .g = 0.8, .eta = 1.3};
  }
  scene.lights.push_back(ParallelLight{.azimuth = 0, .elevation = 0});
  scene.camera = PinholeCamera{.position = {0, 0, -300}, .target = {0, 0, 0}, .fov = 1.6};
  RenderSettings settings = settingsOf(8);
  settings.components.single = settings.components.surface = false;
  settings.aovs = {"radiosity"};
  VolumeSolver solver;
  solver.update(scene, {.cells = 24, .collisions = 12});
  for (int pass = 0; pass < 4; ++pass) solver.refine();
  const double ours = meanOf(solver.picture(settings), "radiosity");
  settings.method = Method::kWalk;
  settings.samples = 20000;
  EXPECT_NEAR(ours / meanOf(renderReference(scene, settings), "radiosity"), 1, 0.03);
}

}  // namespace
}  // namespace lychnite
