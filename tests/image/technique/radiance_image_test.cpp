// Radiances with a closed form.
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/phase.h"
#include "lychnite/optics/profile.h"
#include "lychnite/optics/surface.h"
#include "render_test.h"

namespace lychnite {
namespace {

constexpr double kPi = std::numbers::pi;

/// A plate or disc of `size` mm facing +z, seen from the front.
Scene facing(const std::string& model, double size, const Coefficients& medium) {
  Scene scene = oneObject(model, size);
  scene.objects[0].material.medium = medium;
  scene.lights = {ParallelLight{.azimuth = 0, .elevation = 0}};
  scene.camera = distantCamera({0, 0, 1}, 0.5 * size);
  return scene;
}

void expectRelative(const glm::dvec3& value, const glm::dvec3& expected, double tolerance,
                    const std::string& what) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(value[c], expected[c], tolerance * expected[c]) << what << ", channel " << c;
}

using RadianceImage = RenderTest;

TEST_F(RadianceImage, WhiteLambertFacingTheLightIsOne) {
  for (const Rgb& colour : {Rgb(1), Rgb(0.2, 0.5, 0.8)}) {
    Scene scene = facing("slab", 50, {.eta = 1});
    scene.objects[0].material.opaque = true;
    scene.objects[0].material.colour = colour;
    expectRelative(centreOf(render(scene, smallPicture())), colour, 1e-5, "facing");
    scene.lights = {ParallelLight{.azimuth = 60, .elevation = 0}};
    expectRelative(centreOf(render(scene, smallPicture())), colour * 0.5, 1e-4, "at 60 degrees");
    scene.lights = {ParallelLight{.azimuth = 120, .elevation = 0}};
    EXPECT_EQ(centreOf(render(scene, smallPicture())), glm::dvec3(0)) << "from behind";
  }
}

TEST_F(RadianceImage, PointLightFallsWithTheSquareOfTheDistance) {
  Scene scene = facing("disc", 50, {.eta = 1});
  scene.objects[0].material.opaque = true;
  scene.objects[0].material.colour = Rgb(0.5);
  for (const double distance : {60.0, 120.0, 1000.0}) {
    scene.lights = {PointLight{.position = {0, 0, distance}, .intensity = Rgb(1e4)}};
    // The middle pixel sees points up to 0.4 mm off the axis.
    expectRelative(centreOf(render(scene, smallPicture())), Rgb(0.5 * 1e4 / (kPi * distance * distance)),
                   1e-3, std::to_string(distance));
  }
}

TEST_F(RadianceImage, TheCoatIsThatOfOptics) {
  const Coefficients medium{.sigma_s = Rgb(1), .sigma_a = Rgb(1), .g = 0, .eta = 1.5};
  for (const double roughness : {0.1, 0.3, 0.8})
    for (const double azimuth : {20.0, 35.0, 60.0}) {
      Scene scene = facing("disc", 50, medium);
      scene.objects[0].material.roughness = roughness;
      scene.lights = {ParallelLight{.azimuth = -30, .elevation = 0}};
      const glm::dvec3 wo = directionFromAngles(azimuth, 0);
      scene.camera = distantCamera(wo, 25);
      RenderSettings settings = smallPicture(Method::kAdaptive, 97);
      settings.components = only("surface");
      const Rgb expected = kPi * surfaceResponse({.eta = 1.5, .roughness = roughness, .base = Rgb(0)},
                                                 {0, 0, 1}, wo, directionFromAngles(-30, 0));
      expectRelative(centreOf(render(scene, settings)), expected, 2e-3, std::to_string(azimuth));
    }
}

TEST_F(RadianceImage, AmbientIsAWhiteFurnace) {
  // A white base under any coat gives back all of a uniform surrounding: Fresnel plus what the coat lets
  // through.
  for (const double eta : {1.0, 1.5}) {
    Scene scene = oneObject("sphere", 20);
    scene.lights.clear();
    scene.ambient = {0.5, 1, 2};
    scene.objects[0].material.medium.eta = eta;
    scene.objects[0].material.opaque = true;
    scene.objects[0].material.colour = Rgb(1);
    const Image image = render(scene, smallPicture());
    for (size_t i = 0; i < image.pixelCount(); ++i) {
      if (image.channel("A")[i] < 1) continue;
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(image.rgb(i)[c], scene.ambient[c], 1e-5) << eta;
    }
  }
}

TEST_F(RadianceImage, AmbientOnTranslucenceIsTheHalfSpace) {
  const Coefficients skin = findMaterial("skin1", "").coefficients;
  Scene scene = facing("disc", 50, skin);
  scene.lights.clear();
  scene.ambient = Rgb(1);
  const Rgb total = makeDipole(skin)->P(0);
  const double mirrored = fresnelReflectance(1, skin.eta);
  expectRelative(centreOf(render(scene, smallPicture())), mirrored + (1 - mirrored) * total, 1e-4, "ambient");
}

/// Single scattering of a plate of thickness d at normal incidence, seen along the normal: light enters with
/// Ft, is weakened over the depth s twice, is scattered straight back, and leaves with Ft / eta^2 (radiance
/// spreads): L1 = sigma_s p(-1) Ft^2 / eta^2 E0 (1 - e^(-2 sigma_t d)) / (2 sigma_t).
Rgb plateSingle(const Coefficients& m, double d) {
  const double Ft = fresnelTransmittance(1, m.eta);
  Rgb result;
  for (int c = 0; c < 3; ++c) {
    const double sigma_t = m.sigma_t()[c];
    result[c] = m.sigma_s[c] * henyeyGreenstein(-1, m.g) * Ft * Ft / (m.eta * m.eta) * kPi *
                -std::expm1(-2 * sigma_t * d) / (2 * sigma_t);
  }
  return result;
}

TEST_F(RadianceImage, SingleScatteringOfAPlateIsTheClosedForm) {
  // The plate's thickness is a tenth of its side: 2 mm. Thin in one channel, dense in another.
  for (const double eta : {1.0, 1.4})
    for (const double g : {0.0, 0.4, -0.3}) {
      const Coefficients medium{.sigma_s = {0.05, 0.5, 3}, .sigma_a = {0.01, 0.1, 0.2}, .g = g, .eta = eta};
      const Scene scene = facing("slab", 20, medium);
      RenderSettings settings = smallPicture();
      settings.components = only("single");
      settings.singleSamples = 64;
      // The depths are those of a 512 map: a texel is 0.06 mm, 3 % of the plate.
      expectRelative(centreOf(render(scene, settings)), plateSingle(medium, 2), 0.02, std::to_string(eta));
    }
}

TEST_F(RadianceImage, SingleScatteringNeedsFewSamples) {
  const Coefficients medium{.sigma_s = {1, 2, 3}, .sigma_a = {0.1, 0.1, 0.2}, .g = 0, .eta = 1.3};
  RenderSettings settings = smallPicture();
  settings.components = only("single");
  settings.singleSamples = 8;
  expectRelative(centreOf(render(facing("slab", 20, medium), settings)), plateSingle(medium, 2), 0.05,
                 "8 samples");
}

TEST_F(RadianceImage, MatchedMultipleScatteringOfALargeDiscIsTheProfilesTotal) {
  // Uniform light on a flat disc of radius R, at its middle: B = (P(0) - P(R)) Ft E0, and L = B S_w, whatever
  // the size.
  for (const char* name : {"marble", "skin1", "ketchup"})
    for (const double size : {2.0, 20.0, 200.0}) {
      const Coefficients medium = findMaterial(name, "").coefficients;
      const Scene scene = facing("disc", size, medium);
      RenderSettings settings = smallPicture(Method::kMatched);
      settings.components = only("multiple");
      const auto dipole = makeDipole(medium);
      const Rgb B = (dipole->P(0) - dipole->P(0.5 * size)) * fresnelTransmittance(1, medium.eta) * kPi;
      expectRelative(centreOf(render(scene, settings)), B * exitLobe(1, medium.eta), 0.01,
                     std::string(name) + " " + std::to_string(size));
    }
}

}  // namespace
}  // namespace lychnite
