#include "technique/frame.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "unit/scene/scenes.h"

namespace lychnite {
namespace {

Scene scaledScene(double s) {
  Scene scene = oneObject("knot", 20 * s, "skin1");
  scene.objects[0].material.medium = scene.objects[0].material.medium.scaled(s);
  scene.objects[0].position = s * glm::dvec3(3, 4, 5);
  scene.objects.push_back(makeObject("slab", 60 * s));
  scene.objects[1].material.opaque = true;
  scene.objects[1].position = s * glm::dvec3(0, -20, 0);
  scene.lights.push_back(PointLight{.position = s * glm::dvec3(0, 100, 30), .intensity = Rgb(5e4 * s * s)});
  scene.camera = OrbitCamera{.azimuth = 25, .elevation = 15};
  return scene;
}

double largest(const glm::dmat4& m) {
  double result = 0;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) result = std::max(result, std::abs(m[c][r]));
  return result;
}

TEST(Frame, IsTheSameForAScaledWorld) {
  const Scene smallScene = scaledScene(1), largeScene = scaledScene(1000);
  const Frame a = makeFrame(smallScene, 80, 60), b = makeFrame(largeScene, 80, 60);
  EXPECT_NEAR(b.unit, 1000 * a.unit, 1e-6);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_LT(largest(a.objects[i].toWorld - b.objects[i].toWorld), 1e-12);
    EXPECT_NEAR(a.objects[i].bounds.radius, b.objects[i].bounds.radius, 1e-12);
  }
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(a.objects[0].medium.sigma_s[c], b.objects[0].medium.sigma_s[c], 1e-9);
  const auto &one = std::get<PointLight>(a.lights[1]), &other = std::get<PointLight>(b.lights[1]);
  EXPECT_NEAR(glm::distance(one.position, other.position), 0, 1e-12);
  EXPECT_NEAR(one.intensity.x, other.intensity.x, 1e-9);
  EXPECT_NEAR(glm::distance(a.camera.position, b.camera.position), 0, 1e-9);
  EXPECT_LT(largest(a.toClip - b.toClip), 1e-9);
}

TEST(Frame, TheLargestTranslucentObjectIsTheUnit) {
  Scene scene = scaledScene(1);
  EXPECT_EQ(makeFrame(scene, 8, 8).unit, 20);
  scene.objects[0].material.opaque = true;
  EXPECT_EQ(makeFrame(scene, 8, 8).unit, 60) << "all opaque: the largest";
}

TEST(Frame, TheSubjectIsInTheMiddle) {
  const Scene scene = scaledScene(1);
  const Frame frame = makeFrame(scene, 8, 8);
  EXPECT_NEAR(glm::length(frame.objects[0].bounds.centre), 0, 1e-12);
  const Bounds box = boundsOf(*scene.objects[0].mesh);
  const glm::dvec3 low(frame.objects[0].toWorld * glm::dvec4(box.min, 1));
  const glm::dvec3 high(frame.objects[0].toWorld * glm::dvec4(box.max, 1));
  EXPECT_NEAR(std::max({high.x - low.x, high.y - low.y, high.z - low.z}), 1, 1e-6);
}

TEST(Frame, ClipSpaceIsThePicture) {
  const Scene scene = scaledScene(1);
  const Frame frame = makeFrame(scene, 80, 60);
  for (const glm::dvec3& p : {glm::dvec3(0), glm::dvec3(0.3, -0.2, 0.4), glm::dvec3(-0.5, 0.1, -0.3)}) {
    const glm::dvec4 clip = frame.toClip * glm::dvec4(p, 1);
    const glm::dvec3 pixel = frame.camera.project(p);
    EXPECT_NEAR((clip.x / clip.w + 1) * 40, pixel.x, 1e-9);
    EXPECT_NEAR((1 - clip.y / clip.w) * 30, pixel.y, 1e-9);
    EXPECT_NEAR(clip.w, pixel.z, 1e-9) << "depth along the axis";
    EXPECT_LT(std::abs(clip.z), clip.w);
    const glm::dvec3 world = p * frame.unit + frame.origin;
    const glm::dvec3 there = cameraFrame(scene, 80, 60).project(world);
    EXPECT_NEAR(there.x, pixel.x, 1e-9) << "the same camera as in millimetres";
    EXPECT_NEAR(there.y, pixel.y, 1e-9);
  }
}

}  // namespace
}  // namespace lychnite
