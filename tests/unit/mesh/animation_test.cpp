// Poses of a small box against what they are by hand.
#include "lychnite/mesh/animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "lychnite/base/error.h"
#include "lychnite/mesh/load.h"
#include "mesh/animation_data.h"
#include "unit/mesh/moving_box.h"

namespace lychnite {
namespace {

using sample::MovingBox;

class Animation : public testing::Test {
 protected:
  LoadedMesh load(const MovingBox& box) { return loadMesh(folder_.write("box.glb", box.glb())); }
  LoadedMesh load(const std::string& json, const std::string& buffer) {
    return loadMesh(folder_.write("box.glb", sample::glb(json, buffer)));
  }
  sample::Folder folder_;
};

void expectNear(const glm::vec3& found, const glm::vec3& wanted) {
  EXPECT_LT(glm::length(found - wanted), 1e-5) << found.x << ' ' << found.y << ' ' << found.z;
}

constexpr size_t kLower = 2, kUpper = 6;  // corners (1, 2, 0) and (1, 2, 3)

TEST_F(Animation, AJointTurnsWhatHangsOnIt) {
  MovingBox box;
  box.animate(2, "rotation", MovingBox::kTurns);
  const LoadedMesh loaded = load(box);
  ASSERT_TRUE(loaded.animation);
  ASSERT_EQ(loaded.animation->clips().size(), 1u);
  EXPECT_EQ(loaded.animation->clips()[0].name, "animation 1");
  EXPECT_EQ(loaded.animation->clips()[0].seconds, 2);
  const auto at = [&](double seconds) { return loaded.animation->pose(0, seconds)->positions; };
  expectNear(at(0)[kUpper], {1, 2, 3});
  // About x through (0, 0, 3), by 45 degrees and by 90; times past the end are the end.
  const float r = std::sqrt(0.5f);
  expectNear(at(1)[kUpper], {1, 2 * r, 3 + 2 * r});
  expectNear(at(2)[kUpper], {1, 0, 5});
  expectNear(at(9)[kUpper], {1, 0, 5});
  expectNear(at(2)[kLower], {1, 2, 0});
}

TEST_F(Animation, StepsAndSplines) {
  MovingBox box;
  box.animate(2, "rotation", MovingBox::kTurns, "STEP", "jump");
  box.animate(1, "translation", MovingBox::kSpline, "CUBICSPLINE", "glide");
  const LoadedMesh loaded = load(box);
  ASSERT_EQ(loaded.animation->clips().size(), 2u);
  EXPECT_EQ(loaded.animation->clips()[1].name, "glide");
  expectNear(loaded.animation->pose(0, 1.99)->positions[kUpper], {1, 2, 3});
  expectNear(loaded.animation->pose(0, 2)->positions[kUpper], {1, 0, 5});
  // Hermite at one half: 4/2 + 2 s * 1/8 of the speed it leaves with; both joints go along.
  expectNear(loaded.animation->pose(1, 1)->positions[kUpper], {1, 2, 5.25f});
  expectNear(loaded.animation->pose(1, 1)->positions[kLower], {1, 2, 2.25f});
}

TEST_F(Animation, MorphTargetsAreAddedBeforeTheJointsTurn) {
  MovingBox box;
  box.animate(0, "weights", MovingBox::kFactors);
  const LoadedMesh loaded = load(box);
  expectNear(loaded.animation->pose(0, 0.5)->positions[kUpper], {1, 2, 3.25f});
  box.more = R"(,"weights":[1])";
  box.animate(2, "rotation", MovingBox::kTurns);
  const LoadedMesh lifted = load(box);
  EXPECT_EQ(inspect(*lifted.mesh).bounds.min.z, 1);  // the file's own weights hold at rest
  expectNear(lifted.animation->pose(1, 2)->positions[kUpper], {1, -1, 5});
}

TEST_F(Animation, AtRestJointsStandWhereTheirNodesAre) {
  MovingBox box;
  box.jointsTranslation = "[0,0,7]";
  EXPECT_NEAR(inspect(*load(box).mesh).bounds.max.z, 7, 1e-6);
  EXPECT_FALSE(load(box).animation);  // joints alone do not move
}

TEST_F(Animation, AnObjectKeepsItsBoxWhileItMoves) {
  MovingBox box;
  box.animate(1, "translation", MovingBox::kSpline, "CUBICSPLINE");
  const LoadedMesh loaded = load(box);
  const Extent rest = extentOf(*loaded.mesh);
  for (const double seconds : {0.0, 1.0, 2.0}) {
    const auto mesh = loaded.animation->pose(0, seconds);
    ASSERT_TRUE(mesh->extent);
    EXPECT_EQ(mesh->extent->bounds.min, rest.bounds.min);
    EXPECT_EQ(mesh->extent->bounds.max, rest.bounds.max);
    // The farthest corner at the end: half the box across and 5.5 up.
    EXPECT_GE(mesh->extent->radius, std::sqrt(0.25 + 1 + 5.5 * 5.5));
    EXPECT_EQ(mesh->extent->radius, loaded.animation->pose(0, 0)->extent->radius);
    EXPECT_EQ(mesh->normals.size(), mesh->positions.size());
    for (const glm::vec3& n : mesh->normals) EXPECT_NEAR(glm::length(n), 1, 1e-5);
  }
}

TEST_F(Animation, NodesWithoutSkinsMoveToo) {
  // The turning box under a node that stretches it in y: the turn comes first.
  MovingBox box;
  box.animate(1, "rotation", MovingBox::kTurns);
  std::string json = box.json();
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(json.find(from), std::string::npos) << from;
    json.replace(json.find(from), from.size(), to);
  };
  replace(R"("nodes":[0,1])", R"("nodes":[2])");
  replace(R"({"mesh":0,"skin":0},{"children":[2]},{"translation":[0,0,3]})",
          R"({"mesh":0},{"children":[0]},{"children":[1],"scale":[1,3,1]})");
  const LoadedMesh loaded = load(json, box.buffer());
  expectNear(loaded.animation->pose(0, 0)->positions[kUpper], {1, 6, 3});
  expectNear(loaded.animation->pose(0, 2)->positions[kUpper], {1, -9, 2});
}

TEST_F(Animation, RefusesMotionThatDoesNotFit) {
  const auto errorOf = [&](const std::string& from, const std::string& to) {
    MovingBox box;
    box.animate(2, "rotation", MovingBox::kTurns);
    std::string json = box.json();
    EXPECT_NE(json.find(from), std::string::npos) << from;
    json.replace(json.find(from), from.size(), to);
    try {
      load(json, box.buffer());
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(errorOf("LINEAR", "CUBICSPLINE").find("24 numbers of motion for 2 times"), std::string::npos);
  EXPECT_NE(errorOf("LINEAR", "BEZIER").find("STEP, LINEAR or CUBICSPLINE"), std::string::npos);
  EXPECT_NE(errorOf(R"("joints":[1,2])", R"("joints":[1])").find("joints below the skin's 1"),
            std::string::npos);
  EXPECT_NE(errorOf(R"("joints":[1,2])", R"("joints":[1,9])").find("a node below the 3 nodes"),
            std::string::npos);
  EXPECT_NE(errorOf(R"("skin":0)", R"("skin":3)").find("a skin below the 1"), std::string::npos);
  EXPECT_NE(errorOf(R"("children":[2])", R"("children":[2,1])").find("loop"), std::string::npos);
  EXPECT_NE(errorOf(R"("targets":[{"POSITION":5}])", R"("targets":[{"POSITION":8}])").find("8 vertices"),
            std::string::npos);
}

TEST_F(Animation, RefusesAMomentWithoutFinitePlaces) {
  MovingBox box;
  box.animate(2, "scale", MovingBox::kWild, "STEP", "burst");
  const LoadedMesh loaded = load(box);
  const auto mesh = loaded.animation->pose(0, 1.9);  // the other moments are as they would be without it
  expectNear(mesh->positions[kUpper], {1, 2, 3});
  EXPECT_LT(mesh->extent->radius, 2);
  for (const glm::vec3& n : mesh->normals) EXPECT_NEAR(glm::length(n), 1, 1e-5);
  try {
    loaded.animation->pose(0, 2);
    FAIL() << "no error";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("burst at 2 s"), std::string::npos) << text;
    EXPECT_NE(text.find("past the range of floats"), std::string::npos) << text;
  }
}

TEST_F(Animation, RefusesAMomentFarPastTheModelsSize) {
  MovingBox box;
  box.animate(2, "scale", MovingBox::kWild, "LINEAR", "burst");
  const LoadedMesh loaded = load(box);
  EXPECT_NO_THROW(loaded.animation->pose(0, 0));
  EXPECT_THROW(loaded.animation->pose(0, 1), Error);  // finite still
}

TEST(SampledRotation, TakesTheShortWay) {
  AnimationData::Sampler sampler{.times = {0, 1}, .components = 4, .values = {0, 0, 0, 1, 0, 0, 0.6, -0.8}};
  // The second key is the same turn as (0, 0, -0.6, 0.8): half of it has the angle's half.
  const std::vector<double> half = sampled(sampler, 0.5, true);
  const double angle = 0.5 * std::asin(0.6);
  EXPECT_NEAR(std::abs(half[3]), std::cos(angle), 1e-9);
  EXPECT_NEAR(half[2] / half[3], -std::tan(angle), 1e-9);
}

}  // namespace
}  // namespace lychnite
