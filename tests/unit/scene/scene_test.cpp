#include "lychnite/scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "unit/scene/scenes.h"

namespace lychnite {
namespace {

void expectNear(const glm::dvec3& value, const glm::dvec3& expected, double tolerance = 1e-12) {
  EXPECT_NEAR(glm::distance(value, expected), 0, tolerance)
      << value.x << " " << value.y << " " << value.z << " instead of " << expected.x << " " << expected.y
      << " " << expected.z;
}

TEST(Directions, AnglesAreAsDocumented) {
  expectNear(directionFromAngles(0, 0), {0, 0, 1});
  expectNear(directionFromAngles(90, 0), {1, 0, 0});
  expectNear(directionFromAngles(180, 0), {0, 0, -1});
  expectNear(directionFromAngles(-90, 0), {-1, 0, 0});
  expectNear(directionFromAngles(123, 90), {0, 1, 0});
  expectNear(directionFromAngles(90, 45), {std::sqrt(0.5), std::sqrt(0.5), 0});
}

TEST(PlacementOf, PutsTheBoxAtItsPlaceAndSize) {
  Object object = makeObject("slab", 50);
  object.position = {1, 2, 3};
  const Placement placement = placementOf(object);
  expectNear(placement.point(placement.centre), {1, 2, 3});
  const Bounds box = boundsOf(*object.mesh);
  EXPECT_NEAR(placement.point(box.max).x - placement.point(box.min).x, 50, 1e-5);
  EXPECT_NEAR(placement.point(box.max).z - placement.point(box.min).z, 5, 1e-5);
}

TEST(PlacementOf, TurnsAboutTheBoxCentreWithoutChangingTheSize) {
  Object object = makeObject("slab", 50);
  object.position = {10, 0, 0};
  object.rotation = glm::angleAxis(std::numbers::pi / 2, glm::dvec3(0, 1, 0));  // +z goes to +x
  const Placement placement = placementOf(object);
  expectNear(placement.direction({0, 0, 1}), {1, 0, 0});
  expectNear(placement.point(placement.centre + glm::dvec3(0, 0, 0.05)), {12.5, 0, 0}, 1e-6);
  EXPECT_NEAR(placement.scale, 50, 1e-5);
}

TEST(BoundingSphere, HoldsEveryVertexAndTouchesOne) {
  for (const char* model : {"sphere", "slab", "disc", "knot", "stone"}) {
    Object object = makeObject(model, 30);
    object.position = {5, -3, 2};
    object.rotation = glm::normalize(glm::dquat(0.8, 0.1, 0.5, -0.2));
    const Sphere sphere = boundingSphere(object);
    const Placement placement = placementOf(object);
    double farthest = 0;
    for (const glm::vec3& p : object.mesh->positions)
      farthest = std::max(farthest, glm::distance(placement.point(p), sphere.centre));
    EXPECT_NEAR(farthest, sphere.radius, 1e-4) << model;
  }
}

TEST(BoundingSphere, OfASceneHoldsItsObjects) {
  Scene scene = oneObject("sphere", 20);
  scene.objects.push_back(makeObject("sphere", 10));
  scene.objects[1].position = {40, 0, 0};
  const Sphere both = boundingSphere(scene);
  expectNear(both.centre, {17.5, 0, 0}, 1e-4);
  EXPECT_NEAR(both.radius, 27.5, 1e-4);
  scene.objects[1].material.opaque = true;
  expectNear(boundingSphere(scene, true).centre, {0, 0, 0}, 1e-4);
  EXPECT_NEAR(boundingSphere(scene, true).radius, 10, 1e-4);
  EXPECT_NEAR(boundingSphere(scene).radius, 27.5, 1e-4);
  scene.objects[0].material.opaque = true;
  EXPECT_EQ(boundingSphere(scene, true).radius, 0);
}

class CameraFrames : public testing::TestWithParam<Camera> {};

TEST_P(CameraFrames, AreOrthonormalAndLookAtTheTarget) {
  Scene scene = oneObject("sphere", 20);
  scene.camera = GetParam();
  const CameraFrame frame = cameraFrame(scene, 200, 100);
  EXPECT_NEAR(glm::length(frame.right), 1, 1e-12);
  EXPECT_NEAR(glm::length(frame.up), 1, 1e-12);
  expectNear(glm::cross(frame.right, frame.up), -frame.forward);
  EXPECT_EQ(frame.width, 200);
  EXPECT_NEAR(frame.tanHalfFovX, 2 * frame.tanHalfFovY, 1e-12);
  const glm::dvec3 centre = frame.project(glm::dvec3(0, 0, 0));
  EXPECT_NEAR(centre.x, 100, 1e-6);
  EXPECT_NEAR(centre.y, 50, 1e-6);
}

TEST_P(CameraFrames, ProjectUndoesDirection) {
  Scene scene = oneObject("sphere", 20);
  scene.camera = GetParam();
  const CameraFrame frame = cameraFrame(scene, 64, 48);
  for (double x : {0.0, 10.5, 32.0, 64.0})
    for (double y : {0.0, 24.0, 47.25}) {
      const glm::dvec3 d = frame.direction(x, y);
      EXPECT_NEAR(glm::length(d), 1, 1e-12);
      const glm::dvec3 back = frame.project(frame.position + 7.0 * d);
      EXPECT_NEAR(back.x, x, 1e-9);
      EXPECT_NEAR(back.y, y, 1e-9);
      EXPECT_NEAR(back.z, 7 * glm::dot(d, frame.forward), 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Cameras, CameraFrames,
    testing::Values(Camera(OrbitCamera{}),
                    Camera(OrbitCamera{.azimuth = 130, .elevation = -50, .factor = 2, .fov = 60}),
                    Camera(OrbitCamera{.elevation = 90}), Camera(OrbitCamera{.elevation = -90}),
                    Camera(PinholeCamera{.position = {30, 40, 50}, .target = Rgb(0)}),
                    Camera(PinholeCamera{.position = {0, 90, 0}, .up = {0, 1, 0}})));

TEST(CameraFrame, ThePictureIsUpright) {
  const CameraFrame frame = cameraFrame(oneObject("sphere", 20), 100, 100);
  EXPECT_LT(frame.project({0, 5, 0}).y, 50) << "+y is up, row 0 is the top";
  EXPECT_GT(frame.project({5, 0, 0}).x, 50) << "+x is right from +z";
}

TEST(OrbitCamera, FactorOneTouchesTheNarrowerEdge) {
  for (const auto& [width, height] : {std::pair(300, 100), std::pair(100, 300), std::pair(100, 100)})
    for (double fov : {20.0, 90.0}) {
      Scene scene = oneObject("sphere", 20);
      scene.objects[0].position = {5, 6, 7};
      scene.camera = OrbitCamera{.azimuth = 33, .elevation = 21, .factor = 1, .fov = fov};
      const CameraFrame frame = cameraFrame(scene, width, height);
      const Sphere sphere = boundingSphere(scene);
      // The ray through the middle of the nearer edge is a tangent of the sphere.
      const glm::dvec3 edge =
          width < height ? frame.direction(0, height / 2.0) : frame.direction(width / 2.0, 0);
      const double off = glm::length(glm::cross(sphere.centre - frame.position, edge));
      EXPECT_NEAR(off, sphere.radius, 1e-9 * sphere.radius) << width << "x" << height << " " << fov;
      std::get<OrbitCamera>(scene.camera).factor = 2;
      EXPECT_NEAR(glm::distance(cameraFrame(scene, width, height).position, sphere.centre),
                  2 * glm::distance(frame.position, sphere.centre), 1e-9);
    }
}

TEST(OrbitCamera, FramesTheTranslucentObjects) {
  Scene scene = oneObject("sphere", 20);
  scene.objects.push_back(makeObject("slab", 500));
  scene.objects[1].material.opaque = true;
  scene.objects[1].position = {0, -10, 0};
  const CameraFrame with = cameraFrame(scene, 100, 100),
                    without = cameraFrame(oneObject("sphere", 20), 100, 100);
  expectNear(with.position, without.position, 1e-9);
  scene.objects[0].material.opaque = true;
  EXPECT_GT(glm::length(cameraFrame(scene, 100, 100).position), 500) << "all opaque: all of them";
}

}  // namespace
}  // namespace lychnite
