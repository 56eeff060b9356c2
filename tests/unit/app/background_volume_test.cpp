#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "lychnite/app/background.h"
#include "lychnite/app/view_state.h"
#include "lychnite/reference/reference.h"
#include "lychnite/scene/scene_file.h"
#include "lychnite/volume/volume.h"

namespace lychnite {
namespace {

Scene glowing(const char* model = "sphere") {
  return defaultView(loadObject(model)).scene;
}

RenderSettings small() {
  return {.width = 12, .height = 12, .method = Method::kVolume, .cells = 12, .collisions = 2, .passes = 2};
}

BackgroundVolume::Result after(const BackgroundVolume& volume, int passes) {
  while (volume.problem().empty()) {
    const auto newest = volume.newest();
    if (newest && !newest->behind && (newest->passes >= passes || !newest->obstacle.empty())) return *newest;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return {};
}

TEST(BackgroundVolume, ItsLastPassIsThePictureThatRenderMakes) {
  BackgroundVolume volume({.threads = 1, .passes = 2, .yields = false});
  EXPECT_FALSE(volume.newest());
  volume.want(glowing(), small());
  const auto result = after(volume, 2);
  ASSERT_TRUE(result.image) << volume.problem();
  EXPECT_EQ(result.passes, 2);
  const Image rendered = VolumeSolver().render(glowing(), small());
  for (const char* channel : {"R", "G", "B", "A"})
    EXPECT_EQ(result.image->channel(channel), rendered.channel(channel)) << channel;
}

TEST(BackgroundVolume, ACameraThatMovedKeepsThePasses) {
  BackgroundVolume volume({.threads = 1, .passes = 3, .yields = false});
  Scene scene = glowing();
  volume.want(scene, small());
  after(volume, 3);
  std::get<OrbitCamera>(scene.camera).azimuth += 30;
  volume.want(scene, small());
  const auto moved = after(volume, 1);
  ASSERT_TRUE(moved.image) << volume.problem();
  EXPECT_EQ(moved.passes, 3);
}

TEST(BackgroundVolume, PicturesOfAMovingSceneAreFinished) {
  BackgroundVolume volume({.threads = 1, .yields = false});
  Scene scene = glowing();
  const auto turn = [&] {
    std::get<ParallelLight>(scene.lights[0]).azimuth += 1;
    volume.want(scene, small(), true);
  };
  // Each wish comes long before the picture of the one before.
  std::shared_ptr<const Image> last;
  for (int pictures = 0; pictures < 3;) {
    turn();
    const auto newest = volume.newest();
    ASSERT_EQ(volume.problem(), "");
    if (newest && newest->image && newest->image != last) {
      last = newest->image;
      ++pictures;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  // The last one is of the last wish, alone, and makes no passes, though it is given the time for one.
  while (volume.newest()->behind) {
    ASSERT_EQ(volume.problem(), "");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(std::get<ParallelLight>(volume.newest()->scene.lights[0]).azimuth,
            std::get<ParallelLight>(scene.lights[0]).azimuth);
  EXPECT_EQ(volume.newest()->passes, 0);
  volume.stop();
  EXPECT_FALSE(volume.newest());
}

TEST(BackgroundVolume, OnlyACameraThatMovesKeepsThePhotonsInMotion) {
  BackgroundVolume volume({.threads = 1, .passes = 2, .yields = false});
  Scene scene = glowing();
  volume.want(scene, small());
  after(volume, 2);
  std::get<OrbitCamera>(scene.camera).azimuth += 30;
  volume.want(scene, small(), true);
  EXPECT_EQ(after(volume, 0).passes, 2);
  std::get<ParallelLight>(scene.lights[0]).azimuth += 1;
  volume.want(scene, small(), true);
  EXPECT_EQ(after(volume, 0).passes, 0);
}

TEST(BackgroundVolume, AnOpenMeshIsAnObstacle) {
  BackgroundVolume volume({.threads = 1, .yields = false});
  volume.want(glowing("disc"), small());
  const auto result = after(volume, 1);
  EXPECT_FALSE(result.image);
  EXPECT_NE(result.obstacle.find("open"), std::string::npos) << result.obstacle;
}

TEST(BackgroundVolume, StopsAtOnce) {
  BackgroundVolume volume({.threads = 1});
  volume.want(glowing(), small());
  volume.stop();
  EXPECT_FALSE(volume.newest());
}

TEST(BackgroundVolume, SaysWhatIsWrong) {
  BackgroundVolume volume({.threads = 1, .yields = false});
  Scene bad = glowing();
  bad.objects[0].material.roughness = 7;
  volume.want(bad, small());
  after(volume, 1);
  EXPECT_NE(volume.problem().find("roughness"), std::string::npos) << volume.problem();
}

TEST(BackgroundDipole, IsTheJudgesPicture) {
  BackgroundDipole dipole(1, false);
  RenderSettings settings = small();
  settings.components = {.multiple = true, .single = false, .surface = false};
  dipole.want(glowing(), settings);
  while (!dipole.newest()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  settings.method = Method::kDipole;
  EXPECT_EQ(dipole.newest()->channel("G"), renderReference(glowing(), settings).channel("G"));
}

}  // namespace
}  // namespace lychnite
