// Where the picture's pixels lie: coverage, depth and normals of a sphere against the exact ones.
#include <glm/geometric.hpp>
#include <optional>

#include "render_test.h"

namespace lychnite {
namespace {

constexpr double kPi = 3.14159265358979323846;

Scene sphereScene(double factor = 1.3) {
  Scene scene = oneObject("sphere", 20);
  scene.camera = OrbitCamera{.azimuth = 20, .elevation = 30, .factor = factor, .fov = 40};
  return scene;
}

/// Distance to the sphere of radius 10 about the origin along a ray.
std::optional<double> hitSphere(const glm::dvec3& o, const glm::dvec3& d) {
  const double b = glm::dot(o, d), disc = b * b - glm::dot(o, o) + 100;
  if (disc < 0) return std::nullopt;
  return -b - std::sqrt(disc);
}

using GeometryImage = RenderTest;

TEST_F(GeometryImage, CoverageOfASphereIsItsArea) {
  const Scene scene = sphereScene();
  const Image image = render(scene, smallPicture(Method::kAdaptive, 128));
  double covered = 0;
  for (const float a : image.channel("A")) covered += double(a);
  const CameraFrame camera = cameraFrame(scene, 128, 128);
  const double distance = glm::length(camera.position), sine = 10 / distance;
  const double radius = sine / std::sqrt(1 - sine * sine) / camera.tanHalfFovY * 64;
  // 0.2 %: the mesh is inscribed (0.03 %), and 2 x 2 samples along a rim of 310 pixels leave about as much.
  EXPECT_NEAR(covered, kPi * radius * radius, 2e-3 * kPi * radius * radius);
}

TEST_F(GeometryImage, CoverageIsInQuartersAndTheInsideIsFull) {
  const Scene scene = sphereScene();
  const Image image = render(scene, smallPicture());
  const CameraFrame camera = cameraFrame(scene, 96, 96);
  size_t partly = 0;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      const float a = image.channel("A")[pixelAt(image, x, y)];
      EXPECT_EQ(a * 4, std::round(a * 4)) << x << ", " << y;
      partly += a > 0 && a < 1 ? 1 : 0;
      const double off = glm::length(glm::cross(camera.position, camera.direction(x + 0.5, y + 0.5)));
      if (off < 9.5) {
        EXPECT_EQ(a, 1) << x << ", " << y;
      } else if (off > 10.5) {
        EXPECT_EQ(a, 0) << x << ", " << y;
      }
    }
  EXPECT_GT(partly, 100u) << "the rim is anti-aliased";
}

TEST_F(GeometryImage, DepthAndNormalAreTheSpheres) {
  const Scene scene = sphereScene();
  RenderSettings settings = smallPicture();
  settings.aovs = {"depth", "normal"};
  const Image image = render(scene, settings);
  const CameraFrame camera = cameraFrame(scene, 96, 96);
  size_t compared = 0;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      const size_t i = pixelAt(image, x, y);
      const glm::dvec3 d = camera.direction(x + 0.5, y + 0.5);
      const auto t = hitSphere(camera.position, d);
      if (image.channel("A")[i] == 0) {
        EXPECT_EQ(image.channel("depth.Z")[i], 0);
      }
      if (!t || image.channel("A")[i] < 1) continue;
      const glm::dvec3 n = (camera.position + d * *t) / 10.0;
      if (-glm::dot(n, d) < 0.3) continue;
      ++compared;
      // Facets lie up to 0.002 mm below the sphere, and the mean depth of a pixel's corners up to 0.01 mm.
      EXPECT_NEAR(image.channel("depth.Z")[i], *t * glm::dot(d, camera.forward), 0.02) << x << ", " << y;
      const glm::dvec3 shown(image.channel("normal.X")[i], image.channel("normal.Y")[i],
                             image.channel("normal.Z")[i]);
      EXPECT_NEAR(glm::length(shown), 1, 1e-5);
      EXPECT_GT(glm::dot(shown, n), std::cos(0.5 * kPi / 180)) << x << ", " << y;
    }
  EXPECT_GT(compared, 2000u);
}

TEST_F(GeometryImage, TheBackgroundShowsBesideAndThroughTheRim) {
  Scene scene = sphereScene();
  scene.lights.clear();
  scene.background = {1, 2, 3};
  const Image image = render(scene, smallPicture());
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    const float open = 1 - image.channel("A")[i];
    EXPECT_NEAR(glm::distance(image.rgb(i), open * glm::vec3(1, 2, 3)), 0, 1e-6) << "pixel " << i;
  }
}

TEST_F(GeometryImage, TheTopRowIsTheTop) {
  Scene scene = sphereScene();
  scene.objects[0].position = {4, 6, 0};
  scene.camera = distantCamera({0, 0, 1}, 40);
  const Image image = render(scene, smallPicture());
  double x = 0, y = 0, sum = 0;
  for (int j = 0; j < 96; ++j)
    for (int i = 0; i < 96; ++i) {
      const double a = double(image.channel("A")[pixelAt(image, i, j)]);
      x += a * (i + 0.5), y += a * (j + 0.5), sum += a;
    }
  EXPECT_NEAR(x / sum, 48 + 4 * 96 / 40.0, 0.1);
  EXPECT_NEAR(y / sum, 48 - 6 * 96 / 40.0, 0.1);
}

}  // namespace
}  // namespace lychnite
