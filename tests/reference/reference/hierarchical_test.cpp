#include <gtest/gtest.h>

#include "lychnite/base/error.h"
#include "lychnite/reference/reference.h"
#include "reference/hierarchical.h"
#include "reference/reference/dipole_scenes.h"

namespace lychnite {
namespace {

struct Case {
  const char* model;
  const char* material;
  double size;
};

class Hierarchical : public testing::TestWithParam<Case> {};

TEST_P(Hierarchical, AgreesWithTheDirectSum) {
  const Case& how = GetParam();
  const RayScene rays(test::litScene(how.model, how.material, how.size, 140));
  const CameraReceivers receivers = findReceivers(rays, 24, 24);
  RenderSettings settings = test::picture(24, 0.004);
  const DiffusionSum direct = sumDipole(rays, receivers, settings);
  settings.method = Method::kHierarchical;
  settings.seed = 5;
  const DiffusionSum tree = sumHierarchical(rays, receivers, settings);
  EXPECT_LT(test::relativeError(tree, direct, receivers), 0.01);
  EXPECT_LE(tree.samples, 4u * 1024 * 1024);
}

INSTANTIATE_TEST_SUITE_P(Models, Hierarchical,
                         testing::Values(Case{"knot", "marble", 1}, Case{"knot", "fig6", 10},
                                         Case{"stone", "skin1", 30}, Case{"sphere", "skimmilk", 100},
                                         Case{"knot", "marble", 300}));

TEST(HierarchicalPicture, ScalesWithTheWorld) {
  Scene small = test::litScene("knot", "skin2", 5, 60);
  Scene large = small;
  large.objects[0].size *= 20;
  large.objects[0].material.medium = large.objects[0].material.medium.scaled(20);
  RenderSettings settings = test::picture(24);
  settings.method = Method::kHierarchical;
  const Image a = renderReference(small, settings), b = renderReference(large, settings);
  for (size_t i = 0; i < a.pixelCount(); ++i)
    EXPECT_LT(glm::distance(a.rgb(i), b.rgb(i)), 2e-3f * glm::length(a.rgb(i)) + 1e-5f);
}

TEST(HierarchicalPicture, StopsWhenInterrupted) {
  RenderSettings settings = test::picture(32);
  settings.method = Method::kHierarchical;
  const Progress progress([](const Progress::Update&) { return false; });
  EXPECT_THROW(renderReference(test::litScene("stone", "marble", 20, 40), settings, progress), Interrupted);
}

}  // namespace
}  // namespace lychnite
