#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "lychnite/base/error.h"
#include "property/random.h"
#include "technique/light_map/light_view.h"
#include "technique/multiple/lattice.h"
#include "unit/scene/scenes.h"

namespace lychnite {
namespace {

TEST(LightViewProperties, HoldAnyObjectUnderAnyLight) {
  Random random(1);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    const char* models[]{"sphere", "slab", "disc", "stone"};
    Scene scene = oneObject(models[i % 4], random.logUniform(1e-2, 1e4));
    Object& object = scene.objects[0];
    object.rotation = glm::angleAxis(random.uniform(-3, 3), random.direction());
    object.position = object.size * random.rgb(-3, 3);
    const double radius = boundingSphere(object).radius;
    if (random.coin())
      scene.lights = {
          ParallelLight{.azimuth = random.uniform(-180, 180), .elevation = random.uniform(-90, 90)}};
    else
      scene.lights = {
          PointLight{.position = object.position + random.logUniform(1.01, 1e4) * radius * random.direction(),
                     .intensity = Rgb(1)}};
    const Frame frame = makeFrame(scene, 32, 32);
    LightView view;
    try {
      view = fitLightView(frame, 0, 0);
    } catch (const Error&) {
      ++refused;
      continue;
    }
    const glm::dmat4 toClip = view.toClip();
    for (size_t v = 0; v < object.mesh->positions.size(); v += 53) {
      const glm::dvec3 p(frame.objects[0].toWorld * glm::dvec4(object.mesh->positions[v], 1));
      const glm::dvec3 m = view.project(p);
      ASSERT_GT(std::min(m.x, m.y), 0) << i;
      ASSERT_LT(std::max(m.x, m.y), 1) << i;
      ASSERT_LE(m.z, view.backgroundDepth + 1e-9) << i;
      const glm::dvec4 clip = toClip * glm::dvec4(p, 1);
      ASSERT_LE(std::abs(clip.z), clip.w * (1 + 1e-6)) << i;
      ASSERT_NEAR(glm::distance(view.unproject(glm::dvec2(m), m.z), p), 0,
                  1e-9 * (1 + glm::length(view.origin)))
          << i;
    }
  }
  EXPECT_LT(refused, 60) << "only point lights nearly in the object";
}

TEST(LatticeProperties, LevelsRiseOutwardsAndAreasFollow) {
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const auto cells = makeLattice(random.uniform(0, 3), int(random.uniform(0, 12)));
    for (const glm::vec4& cell : cells) {
      EXPECT_GE(cell.z, 0);
      EXPECT_EQ(cell.w, std::exp2(2 * cell.z));
      EXPECT_EQ(cell.x, -cells[size_t(48 - (&cell - cells.data()))].x) << "symmetric about the middle";
    }
    for (int x = 1; x <= 3; ++x) EXPECT_GE(cells[size_t(24 + x)].z, cells[size_t(23 + x)].z);
  }
}

}  // namespace
}  // namespace lychnite
