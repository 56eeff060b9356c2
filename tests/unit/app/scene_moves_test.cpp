#include "lychnite/app/scene_moves.h"
#include "lychnite/base/error.h"
#include "lychnite/scene/scene_file.h"
#include "unit/mesh/moving_box.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "lychnite/app/view_state.h"
#include "lychnite/scene/scene_file.h"

namespace lychnite {
namespace {

Scene figurine() {
  return defaultView(loadObject("stone")).scene;
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  EXPECT_NEAR(glm::distance(a, b), 0, tolerance);
}

TEST(SceneMoves, PanningAnOrbitCameraKeepsTheView) {
  Scene scene = figurine();
  const CameraFrame before = cameraFrame(scene, 100, 100);
  panCamera(scene, 0, 0);
  ASSERT_TRUE(std::holds_alternative<PinholeCamera>(scene.camera));
  const CameraFrame after = cameraFrame(scene, 100, 100);
  expectNear(before.position, after.position, 1e-9);
  expectNear(before.forward, after.forward, 1e-12);
}

TEST(SceneMoves, APannedPointFollowsTheHand) {
  Scene scene = figurine();
  const glm::dvec3 point = scene.objects[0].position;
  const glm::dvec3 before = cameraFrame(scene, 200, 100).project(point);
  panCamera(scene, 0.1, 0.2);
  const glm::dvec3 after = cameraFrame(scene, 200, 100).project(point);
  EXPECT_NEAR(after.x - before.x, 10, 1e-6);
  EXPECT_NEAR(after.y - before.y, -20, 1e-6);
}

TEST(SceneMoves, OrbitingAPinholeCameraIsOrbiting) {
  Scene a = figurine(), b = figurine();
  panCamera(b, 0, 0);
  orbitCamera(a, 30, 20);
  orbitCamera(b, 30, 20);
  expectNear(cameraFrame(a, 64, 64).position, cameraFrame(b, 64, 64).position, 1e-9);
  zoomCamera(a, 0.5);
  zoomCamera(b, 0.5);
  expectNear(cameraFrame(a, 64, 64).position, cameraFrame(b, 64, 64).position, 1e-9);
  fitCamera(b);
  ASSERT_TRUE(std::holds_alternative<OrbitCamera>(b.camera));
  expectNear(cameraFrame(b, 64, 64).forward, cameraFrame(a, 64, 64).forward, 1e-9);
}

TEST(SceneMoves, ElevationsStopBeforeThePole) {
  Scene scene = figurine();
  orbitCamera(scene, 0, 500);
  EXPECT_EQ(std::get<OrbitCamera>(scene.camera).elevation, 89);
  turnLight(scene, 0, 0, -500);
  EXPECT_EQ(std::get<ParallelLight>(scene.lights[0]).elevation, -89);
  turnLight(scene, 99, 1, 1);  // no such light: nothing happens
}

TEST(SceneMoves, ViewsLookFromWhereTheyAreNamed) {
  Scene scene = figurine();
  setView(scene, 2);
  expectNear(cameraFrame(scene, 64, 64).forward, {-1, 0, 0}, 1e-9);
  setView(scene, 3);
  expectNear(cameraFrame(scene, 64, 64).forward, {0, 0, 1}, 1e-9);
  const double azimuth = std::get<OrbitCamera>(scene.camera).azimuth;
  setView(scene, 0);
  EXPECT_EQ(std::get<OrbitCamera>(scene.camera).azimuth, azimuth);
}

TEST(SceneMoves, SizesKeepTheViewAndStayInRange) {
  Scene scene = figurine();
  panCamera(scene, 0.3, 0);
  const glm::dvec3 before = cameraFrame(scene, 100, 100).project(scene.objects[0].position);
  setSubjectSize(scene, 300);
  EXPECT_EQ(scene.objects[0].size, 300);
  const glm::dvec3 after = cameraFrame(scene, 100, 100).project(scene.objects[0].position);
  EXPECT_NEAR(before.x, after.x, 1e-6);
  setSubjectSize(scene, 1e9);
  EXPECT_EQ(scene.objects[0].size, 10000);
  setSubjectSize(scene, 0);
  EXPECT_EQ(scene.objects[0].size, 0.1);
}

TEST(SceneMoves, KindsOfLightGiveTheCentreTheSameLight) {
  const Scene scene = figurine();
  const auto& parallel = std::get<ParallelLight>(scene.lights[0]);
  const auto point = std::get<PointLight>(asPoint(scene, parallel));
  const glm::dvec3 away = point.position - scene.objects[0].position;
  expectNear(point.intensity / glm::dot(away, away), parallel.irradiance, 1e-9);
  const auto back = std::get<ParallelLight>(asParallel(scene, point));
  EXPECT_NEAR(back.azimuth, parallel.azimuth, 1e-9);
  EXPECT_NEAR(back.elevation, parallel.elevation, 1e-9);
  expectNear(back.irradiance, parallel.irradiance, 1e-9);
}

TEST(SceneMoves, AWholeTurnIsNone) {
  Scene scene = figurine();
  for (int i = 0; i < 8; ++i) turnLights(scene, 45), turnObjects(scene, 45);
  EXPECT_NEAR(std::get<ParallelLight>(scene.lights[0]).azimuth, 150, 1e-9);
  EXPECT_NEAR(std::abs(scene.objects[0].rotation.w), 1, 1e-9);
}

TEST(SceneMoves, ClipsPlayOnAndBeginAgain) {
  sample::Folder folder;
  sample::MovingBox box;
  box.animate(2, "rotation", sample::MovingBox::kTurns, "LINEAR", "bend");
  Scene scene = figurine();
  scene.objects[0] = loadObject(folder.write("box.glb", box.glb()).string());
  const auto rest = scene.objects[0].mesh;
  ASSERT_EQ(clipOf(scene.objects[0])->name, "bend");
  playClips(scene, 1);  // at rest nothing plays
  EXPECT_EQ(scene.objects[0].mesh, rest);
  const glm::dvec3 camera = cameraFrame(scene, 100, 100).position;
  showClip(scene, "bend", 0);
  expectNear(cameraFrame(scene, 100, 100).position, camera, 1e-9);
  playClips(scene, 1.5);
  EXPECT_NEAR(scene.objects[0].time, 1.5, 1e-9);
  EXPECT_NE(scene.objects[0].mesh, rest);
  playClips(scene, 1);
  EXPECT_NEAR(scene.objects[0].time, 0.5, 1e-9);  // of 2 s
  EXPECT_THROW(setPose(scene.objects[0], "bent", 0), Error);
  setPose(scene.objects[0], "", 0);
  EXPECT_EQ(scene.objects[0].mesh, rest);
}

}  // namespace
}  // namespace lychnite
