// Pictures as they were when somebody last looked at them (tests/golden, made by LYCHNITE_UPDATE_GOLDENS=1).
#include "golden.h"
#include "render_test.h"

namespace lychnite {
namespace {

const std::string kSmooth =
    "half precision of the golden (0.0005) and the order of float operations on another driver, on smooth "
    "shading; a wrong "
    "factor or a lost sample is several times that";
const std::string kEdges =
    "shadow edges and thin parts in the light map: a texel more or less of the map moves them by a part of a "
    "pixel";

/// The lattice of the day these were made, so that a better fit of its constants leaves them alone.
RenderSettings settingsOf(Method method, int size = 96) {
  RenderSettings settings = smallPicture(method, size);
  settings.lattice = {.C1 = 1.75, .C2 = 0.375, .K = 1};
  return settings;
}

Scene litKnot() {
  Scene scene = oneObject("knot", 15, "skin1");
  scene.lights = {ParallelLight{.azimuth = 150, .elevation = 30}};
  return scene;
}

using GoldenImage = RenderTest;

TEST_F(GoldenImage, KnotAdaptive) {
  expectGolden("knot_adaptive", render(litKnot(), settingsOf(Method::kAdaptive)), {""},
               {0.05, 0.002, kEdges});
}

TEST_F(GoldenImage, KnotFixed) {
  expectGolden("knot_fixed", render(litKnot(), settingsOf(Method::kFixed)), {""}, {0.05, 0.002, kEdges});
}

TEST_F(GoldenImage, KnotMatched) {
  expectGolden("knot_matched", render(litKnot(), settingsOf(Method::kMatched)), {""}, {0.05, 0.002, kEdges});
}

TEST_F(GoldenImage, StoneInLayersUnderAPointLight) {
  Scene scene = oneObject("stone", 30, "wholemilk");
  scene.lights = {PointLight{.position = {-20, 30, 30}, .intensity = {3000, 2500, 2000}}};
  RenderSettings settings = settingsOf(Method::kAdaptive, 64);
  settings.aovs = {"multiple", "single", "surface"};
  expectGolden("stone_layers", render(scene, settings), {"multiple", "single", "surface"},
               {0.02, 0.001, kSmooth});
}

TEST_F(GoldenImage, FigurineUnderTwoLights) {
  Scene scene = oneObject("figurine", 20, "marble");
  scene.lights = {ParallelLight{.azimuth = -40, .elevation = 35, .irradiance = Rgb(1.5, 1.4, 1.2)},
                  ParallelLight{.azimuth = 170, .elevation = 10, .irradiance = Rgb(1, 1.5, 3)}};
  scene.camera = OrbitCamera{.azimuth = -50, .elevation = 10};
  expectGolden("figurine_two_lights", render(scene, settingsOf(Method::kAdaptive)), {""},
               {0.1, 0.003, kEdges});
}

TEST_F(GoldenImage, SphereOnOpaqueGround) {
  Scene scene = oneObject("sphere", 12, "apple");
  scene.objects.push_back(makeObject("slab", 60));
  Object& ground = scene.objects[1];
  ground.material.opaque = true;
  ground.material.colour = {0.3, 0.4, 0.5};
  ground.rotation = glm::dquat(std::sqrt(0.5), std::sqrt(0.5), 0, 0);
  ground.position = {0, -9, 0};
  scene.camera = OrbitCamera{.azimuth = 20, .elevation = 35, .factor = 1.8};
  expectGolden("sphere_on_ground", render(scene, settingsOf(Method::kAdaptive)), {""}, {0.1, 0.003, kEdges});
}

TEST_F(GoldenImage, CandleInAmbientLight) {
  Scene scene = oneObject("candle", 80, "cream");
  scene.ambient = {0.2, 0.25, 0.3};
  scene.background = {0.02, 0.02, 0.03};
  expectGolden("candle_ambient", render(scene, settingsOf(Method::kAdaptive)), {""}, {0.1, 0.003, kEdges});
}

}  // namespace
}  // namespace lychnite
