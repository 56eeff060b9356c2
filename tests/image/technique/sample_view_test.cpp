// What the viewer shows of a pixel's samples is what the method's shader adds up for it.
#include <numeric>

#include "lychnite/optics/fresnel.h"
#include "render_test.h"
#include "technique/renderer_textures.h"

namespace lychnite {
namespace {

using SampleViewImage = RenderTest;

constexpr int kSize = 33;

Scene litSphere() {
  Scene scene = oneObject("sphere", 5);
  scene.lights = {ParallelLight{.azimuth = 60, .elevation = 20}};
  return scene;
}

RenderSettings multiple(Method method) {
  RenderSettings settings = smallPicture(method, kSize);
  settings.components = only("multiple");
  settings.interpolation = 0;
  return settings;
}

/// The middle pixel's radiosity, from what it radiates towards the camera.
Rgb radiosityOf(const Image& image, const Scene& scene, const SeenSamples& seen) {
  const CameraFrame camera = cameraFrame(scene, kSize, kSize);
  const glm::dvec3 normal = glm::normalize(seen.receiver - scene.objects[0].position);
  const double cosO = glm::dot(normal, glm::normalize(camera.position - seen.receiver));
  return Rgb(centreOf(image)) / exitLobe(cosO, scene.objects[0].material.medium.eta);
}

TEST_F(SampleViewImage, TheLatticesSamplesAddUpToThePixel) {
  const Scene scene = litSphere();
  for (const Method method : {Method::kAdaptive, Method::kFixed}) {
    const RenderSettings settings = multiple(method);
    const Image image = render(scene, settings);
    const auto seen = RendererTextures::samplesAt(*renderer_, scene, settings, {kSize / 2, kSize / 2}, 0);
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->receivers, 1);
    ASSERT_EQ(seen->samples.size(), 49u);
    Rgb sum(0);
    for (const SeenSample& sample : seen->samples) sum += sample.radiosity;
    const Rgb radiated = radiosityOf(image, scene, *seen);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(sum[c] / radiated[c], 1, 2e-3) << methodName(method);  // the sphere is of triangles
      EXPECT_NEAR(seen->radiosity[c] / sum[c], 1, 1e-5) << methodName(method);
    }
  }
}

TEST_F(SampleViewImage, TheMatchedSamplesAreWhereTheLightEnters) {
  const Scene scene = litSphere();
  const RenderSettings settings = multiple(Method::kMatched);
  const Image image = render(scene, settings);
  const auto seen = RendererTextures::samplesAt(*renderer_, scene, settings, {kSize / 2, kSize / 2}, 0);
  ASSERT_TRUE(seen);
  ASSERT_GE(seen->samples.size(), size_t(settings.multipleSamples));
  ASSERT_LE(seen->samples.size(), size_t(settings.multipleSamples) * 4);
  const Rgb radiated = radiosityOf(image, scene, *seen);
  Rgb sum(0);
  for (const SeenSample& sample : seen->samples) {
    sum += sample.radiosity;
    if (sample.radiosity.x <= 0) continue;
    // On the sphere, as far off it as the mip level blurs it.
    const double off = glm::length(sample.position - scene.objects[0].position);
    EXPECT_NEAR(off, 2.5, 0.1 + sample.side);
    EXPECT_LT(sample.side, 5);
    EXPECT_GT(sample.side, 0);
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(seen->radiosity[c] / radiated[c], 1, 2e-3);
    // The rest is the receiver's own texel and what no sample met.
    EXPECT_GT(sum[c], 0.5 * radiated[c]);
    EXPECT_LT(sum[c], 1.001 * radiated[c]);
  }
  EXPECT_NEAR(glm::length(seen->receiverUv - glm::dvec2(0.5)), 0.43,
              0.1);  // on the map's rim: lit from the side
}

TEST_F(SampleViewImage, OutsideTheObjectThereAreNone) {
  const Scene scene = litSphere();
  const RenderSettings settings = multiple(Method::kMatched);
  render(scene, settings);
  EXPECT_FALSE(RendererTextures::samplesAt(*renderer_, scene, settings, {0, 0}, 0));
  EXPECT_FALSE(RendererTextures::samplesAt(*renderer_, scene, settings, {kSize / 2, kSize / 2}, 1));
}

}  // namespace
}  // namespace lychnite
