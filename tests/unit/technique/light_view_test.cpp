#include "technique/light_map/light_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "lychnite/base/error.h"
#include "unit/scene/scenes.h"

namespace lychnite {
namespace {

/// A frame of one sphere (and, when asked for, a slab in front of it) under one light.
struct Lit {
  explicit Lit(const Light& light, bool occluder = false) {
    scene = oneObject("sphere", 20);
    scene.lights = {light};
    if (occluder) {
      scene.objects.push_back(makeObject("slab", 15));
      scene.objects[1].material.opaque = true;
      scene.objects[1].position = {3, 40, 5};
    }
    frame = makeFrame(scene, 64, 64);
    view = fitLightView(frame, 0, 0);
  }
  Scene scene;
  Frame frame;
  LightView view;
};

std::vector<Light> manyLights() {
  std::vector<Light> lights;
  for (double elevation : {-90.0, -89.9, -45.0, 0.0, 35.0, 87.5, 90.0})
    for (double azimuth : {-170.0, -40.0, 0.0, 90.0, 180.0})
      lights.push_back(ParallelLight{.azimuth = azimuth, .elevation = elevation});
  for (double distance : {12.0, 15.0, 40.0, 1e4, 1e6})
    for (const glm::dvec3& d :
         {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::normalize(glm::dvec3(1, 2, -3))})
      lights.push_back(PointLight{.position = distance * d, .intensity = Rgb(1)});
  return lights;
}

/// Points in and on the object's bounding sphere.
std::vector<glm::dvec3> pointsOf(const Sphere& sphere) {
  std::vector<glm::dvec3> points{sphere.centre};
  for (double elevation : {-80.0, -30.0, 10.0, 60.0})
    for (double azimuth = 0; azimuth < 360; azimuth += 45)
      for (double r : {0.5, 1.0})
        points.push_back(sphere.centre + r * sphere.radius * directionFromAngles(azimuth, elevation));
  return points;
}

TEST(LightView, AxesAreOrthonormalForEveryLight) {
  for (const Light& light : manyLights()) {
    const LightView view = Lit(light).view;
    EXPECT_NEAR(glm::length(view.right), 1, 1e-12);
    EXPECT_NEAR(glm::length(view.forward), 1, 1e-12);
    EXPECT_NEAR(glm::distance(glm::cross(view.right, view.forward), view.up), 0, 1e-12);
  }
}

TEST(LightView, ParallelLightTravelsAwayFromItsDirection) {
  const Lit lit(ParallelLight{.azimuth = 30, .elevation = 20});
  EXPECT_NEAR(glm::distance(lit.view.forward, -directionFromAngles(30, 20)), 0, 1e-14);
  EXPECT_FALSE(lit.view.perspective);
  EXPECT_NEAR(lit.view.power.x, 3.14159265, 1e-8);
}

TEST(LightView, PointLightStaysWhereItIsInSceneUnits) {
  const Lit lit(PointLight{.position = {0, 0, 60}, .intensity = {100, 200, 400}});
  EXPECT_TRUE(lit.view.perspective);
  EXPECT_NEAR(glm::distance(lit.view.origin, glm::dvec3(0, 0, 3)), 0, 1e-6) << "60 mm in units of 20 mm";
  EXPECT_NEAR(lit.view.power.y, 0.5, 1e-12) << "intensity in units of its own length squared";
  EXPECT_NEAR(glm::distance(lit.view.travel({0, 0, 0}), glm::dvec3(0, 0, -1)), 0, 1e-6);
}

TEST(LightView, WindowAndDepthsHoldTheWholeObject) {
  for (const Light& light : manyLights()) {
    const Lit lit(light);
    const Placement placement = placementOf(lit.scene.objects[0]);
    for (size_t i = 0; i < lit.scene.objects[0].mesh->positions.size(); i += 7) {
      const glm::dvec3 p =
          (placement.point(lit.scene.objects[0].mesh->positions[i]) - lit.frame.origin) / lit.frame.unit;
      const glm::dvec3 m = lit.view.project(p);
      ASSERT_GT(std::min(m.x, m.y), 0);
      ASSERT_LT(std::max(m.x, m.y), 1);
      ASSERT_GT(m.z, lit.view.nearDepth);
      ASSERT_LT(m.z, lit.view.farDepth);
      ASSERT_LE(m.z, lit.view.backgroundDepth);
    }
  }
}

TEST(LightView, WindowIsWellFilled) {
  // The paper's k_s: the object fills the map at every size and distance.
  for (double size : {1e-3, 1.0, 1e4}) {
    Scene scene = oneObject("sphere", size);
    const LightView view = fitLightView(makeFrame(scene, 64, 64), 0, 0);
    EXPECT_NEAR(2 * view.halfWidth, 1.02, 1e-5) << size << ": window in object sizes";
  }
}

TEST(LightView, UnprojectUndoesProject) {
  for (const Light& light : manyLights()) {
    const Lit lit(light);
    for (const glm::dvec3& p : pointsOf(lit.frame.objects[0].bounds)) {
      const glm::dvec3 m = lit.view.project(p);
      if (m.z <= 0) continue;
      const double scale = lit.view.perspective ? glm::length(lit.view.origin) : 1;
      EXPECT_NEAR(glm::distance(lit.view.unproject(glm::dvec2(m), m.z), p), 0, 1e-12 * (1 + scale));
    }
  }
}

TEST(LightView, ClipSpaceAgreesWithProject) {
  for (const Light& light : manyLights()) {
    const Lit lit(light);
    const glm::dmat4 toClip = lit.view.toClip();
    double lastDepth = -2, lastClip = -2;
    for (const glm::dvec3& p : pointsOf(lit.frame.objects[0].bounds)) {
      const glm::dvec3 m = lit.view.project(p);
      if (m.z <= lit.view.nearDepth) continue;
      const glm::dvec4 clip = toClip * glm::dvec4(p, 1);
      EXPECT_NEAR(0.5 + 0.5 * clip.x / clip.w, m.x, 1e-6);
      EXPECT_NEAR(0.5 + 0.5 * clip.y / clip.w, m.y, 1e-6);
      EXPECT_LE(std::abs(clip.z / clip.w), 1 + 1e-9);
    }
    for (double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const double depth = lit.view.nearDepth + t * (lit.view.farDepth - lit.view.nearDepth);
      const glm::dvec4 clip = toClip * glm::dvec4(lit.view.unproject({0.5, 0.5}, depth), 1);
      EXPECT_GT(clip.z / clip.w, lastClip) << "depth after " << lastDepth;
      lastClip = clip.z / clip.w;
      lastDepth = depth;
    }
    EXPECT_NEAR(lastClip, 1, 1e-6) << "the far plane";
  }
}

TEST(LightView, OccludersBeforeTheObjectAreInFrontOfDepthZero) {
  for (const Light& light : {Light(ParallelLight{.azimuth = 0, .elevation = 90}),
                             Light(PointLight{.position = {0, 90, 0}, .intensity = Rgb(1)})}) {
    const Lit lit(light, true);
    const Sphere& blocker = lit.frame.objects[1].bounds;
    const double depth = lit.view.project(blocker.centre).z;
    EXPECT_GE(depth - blocker.radius, lit.view.nearDepth - 1e-9);
    EXPECT_LT(depth, lit.view.project(lit.frame.objects[0].bounds.centre).z);
  }
}

TEST(LightView, WindowAreaIsThatOfTheSolidAngle) {
  const Lit lit(PointLight{.position = {0, 0, 60}, .intensity = Rgb(1)});
  // Texel areas across the rays over the squared distances sum up to the window's solid angle,
  // 4 asin(t^2 / (1 + t^2)) for a square of half tangent t.
  constexpr int kCells = 200;
  double sum = 0;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const glm::dvec3 p = lit.view.unproject({(i + 0.5) / kCells, (j + 0.5) / kCells}, 2.5);
      const glm::dvec3 d = p - lit.view.origin;
      sum += lit.view.windowArea(p, 2.5) / (kCells * kCells) / glm::dot(d, d);
    }
  const double t2 = lit.view.halfWidth * lit.view.halfWidth;
  EXPECT_NEAR(sum, 4 * std::asin(t2 / (1 + t2)), 1e-5 * sum);
}

TEST(LightView, WindowAreaOfParallelLightIsTheWindow) {
  const Lit lit(ParallelLight{});
  EXPECT_DOUBLE_EQ(lit.view.windowArea({0, 0, 0}, 0.7), 4 * lit.view.halfWidth * lit.view.halfWidth);
}

TEST(LightView, ALightInsideTheObjectIsRefused) {
  for (const glm::dvec3& position : {glm::dvec3(0), glm::dvec3(0, 0, 5), glm::dvec3(0, 9.9, 0)}) {
    try {
      const Lit lit(PointLight{.position = position, .intensity = Rgb(1)});
      ADD_FAILURE() << "a light at " << position.y << ", " << position.z << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Kind::kUsage);
      EXPECT_EQ(error.parts().where, "light 1");
      EXPECT_NE(error.parts().todo.find("walk"), std::string::npos);
    }
  }
}

TEST(LightView, KeysTellViewsApartButNotPowers) {
  const LightView one = Lit(ParallelLight{}).view;
  EXPECT_EQ(one.key(), Lit(ParallelLight{.irradiance = Rgb(7)}).view.key());
  EXPECT_FALSE(one.key() == Lit(ParallelLight{.azimuth = -41}).view.key());
}

}  // namespace
}  // namespace lychnite
