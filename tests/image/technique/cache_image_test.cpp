// What is drawn again when something changed, and that what is kept is right.
#include "render_test.h"

namespace lychnite {
namespace {

const char* const kPasses[]{"light_map", "geometry", "multiple", "single", "surface"};

class CacheImage : public RenderTest {
 protected:
  /// Renders twice with a change in between: which passes ran, one digit each, in kPasses' order. The second
  /// picture must be what a renderer without a past makes of it.
  std::string after(const Scene& before, const Scene& changed) {
    render(before, smallPicture(Method::kAdaptive, 64));
    const Image kept = render(changed, smallPicture(Method::kAdaptive, 64));
    std::string ran;
    for (const char* pass : kPasses) ran += std::to_string(runs(pass));
    Renderer fresh(RendererOptions{.device = "cpu", .debug = true, .log = {}});
    EXPECT_EQ(difference(kept, fresh.render(changed, smallPicture(Method::kAdaptive, 64))), 0);
    return ran;
  }
};

TEST_F(CacheImage, NothingChangedNothingDrawn) {
  const Scene scene = oneObject("sphere", 20);
  EXPECT_EQ(after(scene, scene), "00000");
  EXPECT_EQ(runs("composite"), 1);
}

TEST_F(CacheImage, FirstPictureDrawsEverything) {
  render(oneObject("sphere", 20), smallPicture(Method::kAdaptive, 64));
  for (const char* pass : kPasses) EXPECT_EQ(runs(pass), 1) << pass;
}

TEST_F(CacheImage, TheCameraLeavesTheLightMapAlone) {
  const Scene scene = oneObject("sphere", 20);
  Scene changed = scene;
  changed.camera = OrbitCamera{.azimuth = 40};
  EXPECT_EQ(after(scene, changed), "01111");
}

TEST_F(CacheImage, TheLightsDirectionRedrawsItsMap) {
  const Scene scene = oneObject("sphere", 20);
  Scene changed = scene;
  std::get<ParallelLight>(changed.lights[0]).azimuth = 10;
  EXPECT_EQ(after(scene, changed), "10111");
}

TEST_F(CacheImage, TheLightsPowerShadesAgainOnly) {
  const Scene scene = oneObject("sphere", 20);
  Scene changed = scene;
  std::get<ParallelLight>(changed.lights[0]).irradiance = Rgb(1, 2, 3);
  EXPECT_EQ(after(scene, changed), "00111");
}

TEST_F(CacheImage, OneOfTwoLightsIsRedrawnAlone) {
  Scene scene = oneObject("sphere", 20);
  scene.lights.push_back(ParallelLight{.azimuth = 120});
  Scene changed = scene;
  std::get<ParallelLight>(changed.lights[1]).azimuth = 130;
  EXPECT_EQ(after(scene, changed), "10111") << "one map and one layer each";
}

TEST_F(CacheImage, MaterialAndSizeAreNoticed) {
  const Scene scene = oneObject("sphere", 20);
  Scene material = scene;
  material.objects[0].material.medium = findMaterial("skin1", "").coefficients;
  EXPECT_EQ(after(scene, material).substr(0, 3), "001");
  Scene size = scene;
  size.objects[0].size = 2;
  EXPECT_EQ(after(scene, size)[2], '1') << "the same view of a smaller thing scatters differently";
  Scene roughness = scene;
  roughness.objects[0].material.roughness = 0.6;
  EXPECT_EQ(after(scene, roughness)[4], '1');
  Scene opaque = scene;
  opaque.objects[0].material.opaque = true;
  EXPECT_EQ(after(scene, opaque)[4], '1');
}

TEST_F(CacheImage, ANewMeshIsNoticed) {
  const Scene scene = oneObject("sphere", 20);
  Scene changed = scene;
  Mesh squeezed = *scene.objects[0].mesh;
  for (glm::vec3& p : squeezed.positions) p.x *= 0.5f;
  squeezed.extent.reset();
  changed.objects[0].mesh = std::make_shared<const Mesh>(squeezed);
  EXPECT_EQ(after(scene, changed), "11111");
}

TEST_F(CacheImage, AMovedOccluderIsNoticed) {
  Scene scene = oneObject("sphere", 20);
  scene.lights = {ParallelLight{.azimuth = 0, .elevation = 90}};
  scene.objects.push_back(makeObject("slab", 15));
  scene.objects[1].material.opaque = true;
  scene.objects[1].position = {0, 30, 0};
  Scene changed = scene;
  changed.objects[1].position = {10, 30, 0};
  EXPECT_EQ(after(scene, changed)[0], '2') << "both objects' maps";
}

TEST_F(CacheImage, ResolutionMethodAndSamplesAreNoticed) {
  const Scene scene = oneObject("sphere", 20);
  render(scene, smallPicture(Method::kAdaptive, 64));
  const Image large = render(scene, smallPicture(Method::kAdaptive, 80));
  EXPECT_EQ(large.width(), 80);
  EXPECT_EQ(runs("light_map"), 0);
  EXPECT_EQ(runs("geometry"), 1);
  RenderSettings settings = smallPicture(Method::kAdaptive, 80);
  settings.singleSamples = 3;
  render(scene, settings);
  EXPECT_EQ(runs("single"), 1);
  EXPECT_EQ(runs("multiple"), 0);
  settings.method = Method::kFixed;
  render(scene, settings);
  EXPECT_EQ(runs("multiple"), 1);
  settings.lattice.C1 = 1;
  render(scene, settings);
  EXPECT_EQ(runs("multiple"), 1);
  settings.mapSize = 256;
  render(scene, settings);
  EXPECT_EQ(runs("light_map"), 1);
  settings.profile = ProfileKind::kBetterDipole;
  render(scene, settings);
  EXPECT_EQ(runs("multiple"), 1);
}

TEST_F(CacheImage, AddingAndRemovingLightsAndObjects) {
  const Scene one = oneObject("sphere", 20);
  Scene two = one;
  two.lights.push_back(ParallelLight{.azimuth = 100});
  two.objects.push_back(makeObject("stone", 10, "skin1"));
  two.objects[1].position = {15, 0, 0};
  after(one, two);
  after(two, one);
}

TEST_F(CacheImage, StatisticsTellWhatWasDrawn) {
  const Image image = render(oneObject("sphere", 20), smallPicture(Method::kAdaptive, 64));
  const RenderStats& stats = renderer_->stats();
  EXPECT_EQ(stats.triangles, 20480u);
  EXPECT_EQ(stats.vertices, 10242u);
  EXPECT_TRUE(stats.software);
  size_t covered = 0;
  for (const float a : image.channel("A")) covered += a > 0 ? 1 : 0;
  EXPECT_EQ(stats.coveredPixels, covered);
  EXPECT_GE(stats.mapBytes, size_t(512 * 512 * 8)) << "at least two channels of single precision";
  EXPECT_GT(stats.gpuBytes, stats.mapBytes);
  EXPECT_EQ(image.metadata.at("method"), "adaptive");
}

}  // namespace
}  // namespace lychnite
