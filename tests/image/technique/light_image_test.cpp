// How pictures follow their lights, sizes and objects: laws that hold without a reference picture.
#include <glm/geometric.hpp>

#include "render_test.h"

namespace lychnite {
namespace {

const Method kMethods[]{Method::kAdaptive, Method::kFixed, Method::kMatched};

Scene knotScene(double s = 1) {
  Scene scene = oneObject("knot", 15 * s, "skin1");
  scene.objects[0].material.medium = scene.objects[0].material.medium.scaled(s);
  scene.lights = {ParallelLight{.azimuth = 150, .elevation = 30},
                  PointLight{.position = s * glm::dvec3(10, 25, 20), .intensity = Rgb(700 * s * s)}};
  return scene;
}

using LightImage = RenderTest;

TEST_F(LightImage, SizeAndMeanFreePathCancel) {
  // All that the GPU sees is relative to the object's size; what is left are the last digits of the inputs.
  for (const Method method : kMethods)
    for (const double s : {0.01, 30.0})
      EXPECT_LT(
          difference(render(knotScene(s), smallPicture(method)), render(knotScene(), smallPicture(method))),
          1e-4)
          << methodName(method) << " " << s;
}

TEST_F(LightImage, SizeAloneChangesThePicture) {
  Scene large = knotScene();
  large.objects[0].size *= 4;
  large.lights = {ParallelLight{.azimuth = 150, .elevation = 30}};
  Scene small = knotScene();
  small.lights = large.lights;
  EXPECT_GT(meanOf(render(small, smallPicture())), 1.2 * meanOf(render(large, smallPicture())))
      << "backlit, the small one glows";
}

TEST_F(LightImage, LightsAddUp) {
  for (const Method method : kMethods) {
    Scene scene = knotScene();
    const auto lights = scene.lights;
    const Image both = render(scene, smallPicture(method));
    scene.lights = {lights[0]};
    const Image first = render(scene, smallPicture(method));
    scene.lights = {lights[1]};
    Image sum = render(scene, smallPicture(method));
    for (size_t i = 0; i < sum.pixelCount(); ++i) sum.setRgb(i, sum.rgb(i) + first.rgb(i));
    EXPECT_LT(difference(sum, both), 1e-6) << methodName(method);
  }
}

TEST_F(LightImage, PowerIsLinearAndColoured) {
  Scene scene = knotScene();
  const Image white = render(scene, smallPicture());
  std::get<ParallelLight>(scene.lights[0]).irradiance *= Rgb(2, 0.5, 0);
  std::get<PointLight>(scene.lights[1]).intensity *= Rgb(2, 0.5, 0);
  const Image coloured = render(scene, smallPicture());
  for (size_t i = 0; i < white.pixelCount(); ++i) {
    const glm::vec3 expected = white.rgb(i) * glm::vec3(2, 0.5, 0);
    ASSERT_NEAR(glm::distance(coloured.rgb(i), expected), 0, 1e-6 * (1 + glm::length(expected)));
  }
}

TEST_F(LightImage, LayersAddUpToThePicture) {
  for (const Method method : kMethods) {
    Scene scene = knotScene();
    scene.ambient = Rgb(0.1);
    RenderSettings settings = smallPicture(method);
    settings.aovs = {"multiple", "single", "surface", "lights"};
    const Image image = render(scene, settings);
    Image parts = image, lights = image;
    for (size_t i = 0; i < image.pixelCount(); ++i) {
      parts.setRgb(i, image.rgb(i, "multiple") + image.rgb(i, "single") + image.rgb(i, "surface"));
      lights.setRgb(i, image.rgb(i, "light1") + image.rgb(i, "light2"));
    }
    EXPECT_LT(difference(parts, image), 1e-6) << methodName(method);
    scene.ambient = Rgb(0);
    EXPECT_LT(difference(lights, render(scene, settings)), 1e-6) << methodName(method);
  }
}

TEST_F(LightImage, ComponentsApartAreTheLayers) {
  RenderSettings settings = smallPicture();
  settings.aovs = {"multiple", "single", "surface"};
  const Image whole = render(knotScene(), settings);
  settings.aovs.clear();
  for (const char* name : {"multiple", "single", "surface"}) {
    settings.components = only(name);
    Image layer = whole;
    for (size_t i = 0; i < layer.pixelCount(); ++i) layer.setRgb(i, whole.rgb(i, name));
    EXPECT_LT(difference(render(knotScene(), settings), layer), 1e-6) << name;
  }
}

TEST_F(LightImage, AnOpaqueObjectBeforeTheLightDarkens) {
  for (const Method method : kMethods) {
    Scene scene = oneObject("sphere", 10);
    scene.lights = {ParallelLight{.azimuth = 0, .elevation = 90}};
    scene.camera = distantCamera({0, 0, 1}, 14);
    const double open = meanOf(render(scene, smallPicture(method)));
    Object roof = makeObject("slab", 12);
    roof.material.opaque = true;
    roof.rotation = glm::dquat(std::sqrt(0.5), std::sqrt(0.5), 0, 0);  // lies flat
    roof.position = {0, 60, 0};                                        // far above the picture
    scene.objects.push_back(roof);
    EXPECT_LT(meanOf(render(scene, smallPicture(method))), 0.01 * open)
        << methodName(method) << ": all of the light";
    scene.objects[1].position.x = 6;
    const double half = meanOf(render(scene, smallPicture(method)));
    EXPECT_NEAR(half / open, 0.5, 0.1) << methodName(method) << ": one half of it";
  }
}

TEST_F(LightImage, TheRimHasNoHalo) {
  // A marble sphere lit from the front: with its inside light only, no pixel of the rim is brighter, for what
  // it covers, than the brightest of the full pixels around it.
  for (const Method method : kMethods) {
    Scene scene = oneObject("sphere", 20);
    scene.camera = OrbitCamera{.factor = 1.2};
    RenderSettings settings = smallPicture(method);
    settings.components = only("multiple,single");
    const Image image = render(scene, settings);
    const auto& A = image.channel("A");
    for (int y = 2; y < 94; ++y)
      for (int x = 2; x < 94; ++x) {
        const size_t i = pixelAt(image, x, y);
        if (A[i] == 0 || A[i] == 1) continue;
        float brightest = 0;
        for (int dy = -2; dy <= 2; ++dy)
          for (int dx = -2; dx <= 2; ++dx) {
            const size_t j = pixelAt(image, x + dx, y + dy);
            if (A[j] == 1) brightest = std::max(brightest, image.rgb(j).y);
          }
        EXPECT_LE(image.rgb(i).y, 1.02f * brightest * A[i] + 1e-6f)
            << methodName(method) << " " << x << ", " << y;
      }
  }
}

TEST_F(LightImage, NothingIsNegativeOrNotANumber) {
  for (const char* model : {"knot", "slab", "disc", "stone"})
    for (const Method method : kMethods)
      for (const double eta : {1.0, 1.5}) {
        Scene scene = oneObject(model, 5, "ketchup");
        scene.objects[0].material.medium.eta = eta;
        scene.lights.push_back(PointLight{.position = {0, 8, 0}, .intensity = Rgb(100)});
        const Image image = render(scene, smallPicture(method, 48));
        for (size_t i = 0; i < image.pixelCount(); ++i)
          for (int c = 0; c < 3; ++c) {
            ASSERT_TRUE(std::isfinite(image.rgb(i)[c])) << model << " " << methodName(method) << " " << eta;
            ASSERT_GE(image.rgb(i)[c], 0) << model << " " << methodName(method) << " " << eta;
          }
      }
}

TEST_F(LightImage, DarknessIsBlack) {
  Scene scene = oneObject("sphere", 20);
  scene.lights.clear();
  EXPECT_EQ(meanOf(render(scene, smallPicture())), 0);
  scene.lights = {ParallelLight{.irradiance = Rgb(0)}};
  EXPECT_EQ(meanOf(render(scene, smallPicture())), 0);
}

TEST_F(LightImage, OtherMethodsAreRefused) {
  for (const Method method : {Method::kWalk, Method::kDipole, Method::kHierarchical})
    EXPECT_THROW(render(oneObject("sphere", 20), smallPicture(method)), Error);
  EXPECT_THROW(render(Scene{}, smallPicture()), Error);
}

}  // namespace
}  // namespace lychnite
