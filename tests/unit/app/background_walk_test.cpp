#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "lychnite/app/background.h"
#include "lychnite/app/view_state.h"
#include "lychnite/scene/scene_file.h"

namespace lychnite {
namespace {

Scene glowing(double size) {
  Scene scene = defaultView(loadObject("sphere")).scene;
  scene.objects[0].size = size;
  return scene;
}

RenderSettings small() {
  return {.width = 12, .height = 12};
}

BackgroundWalk::Result firstOf(BackgroundWalk& walk) {
  while (!walk.newest() && walk.problem().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return walk.newest().value_or(BackgroundWalk::Result{});
}

TEST(BackgroundWalk, RefinesWhatIsWanted) {
  BackgroundWalk walk({.threads = 1, .enough = 0.9, .yields = false});
  EXPECT_FALSE(walk.newest());
  walk.want(glowing(3), small());
  const auto result = firstOf(walk);
  ASSERT_TRUE(result.image) << walk.problem();
  EXPECT_EQ(result.image->width(), 12);
  EXPECT_TRUE(result.image->hasRgb("stderr"));
  EXPECT_GT(result.photonsPerPixel, 0);
}

TEST(BackgroundWalk, WantingTheSameGoesOn) {
  BackgroundWalk walk({.threads = 1, .enough = 0.9, .yields = false});
  walk.want(glowing(3), small());
  const auto first = firstOf(walk);
  walk.want(glowing(3), small());
  EXPECT_EQ(walk.newest()->image, first.image);
  walk.want(glowing(4), small());
  const auto other = walk.newest();
  EXPECT_TRUE(!other || other->image != first.image);
}

TEST(BackgroundWalk, StopsAtOnce) {
  BackgroundWalk walk({.threads = 1, .enough = 0});
  walk.want(glowing(3), {.width = 400, .height = 400});
  walk.stop();
  EXPECT_FALSE(walk.newest());
}

TEST(BackgroundWalk, SaysWhatIsWrong) {
  BackgroundWalk walk({.threads = 1, .yields = false});
  Scene bad = glowing(3);
  bad.objects[0].material.roughness = 7;
  walk.want(bad, small());
  firstOf(walk);
  EXPECT_NE(walk.problem().find("roughness"), std::string::npos) << walk.problem();
}

}  // namespace
}  // namespace lychnite
