// Random hands on the viewer. LYCHNITE_SOAK_FRAMES=20000 makes it a long one (ctest label soak, nightly).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "e2e/runner.h"
#include "e2e/x_display.h"
#include "lychnite/image/io.h"
#include "unit/mesh/moving_box.h"

namespace lychnite::e2e {
namespace {

/// Resident memory may grow by this much over two thirds of the run; caches, history and the driver's pools
/// are full before. A short run's first third may not yet have come to `volume`, which holds a solver on
/// either side of the wipe, 80 to 150 MB each.
constexpr double kAllowedGrowth = 300e6;

int soakFrames() {
  const char* text = std::getenv("LYCHNITE_SOAK_FRAMES");
  return text ? std::max(90, std::atoi(text)) : 180;
}

/// A list of input events that stands for about so many frames; the first part of a longer one is a shorter.
std::string randomScript(int frames) {
  std::mt19937 random(7);
  const auto share = [&] { return double(random() % 1000) / 1000; };
  const std::vector<std::string> sliders{"sigma-s-r", "sigma-a-g", "sigma-s-b", "g",
                                         "index",     "roughness", "size"};
  const std::vector<std::string> keys{
      "[", "]", "f", "1", "3", "5", "7", "g", "c", "d", "i", "p", "space", "ctrl+z", "ctrl+shift+z", "h"};
  const std::vector<std::string> models{"sphere", "stone",     "knot",    "slab",
                                        "disc",   "tetra.off", "box.glb", "broken.ply"};
  std::string script = "wait rest\n";
  for (int done = 0, part = 0; done < frames;) {
    if (done / 300 > part) {
      part = done / 300;
      script += "key m\nwait 40\n";  // long enough for volume to begin
      done += 42;
    }
    const int what = int(random() % 16);
    if (what < 5) {
      script += fmt::format("drag @{0}:{1},0.5 @{0}:{2},0.5 left 3\n", sliders[random() % sliders.size()],
                            share(), share());
      done += 7;
    } else if (what < 8) {
      script += fmt::format("drag @picture:{},{} @picture:{},{} {} 3\n", share(), share(), share(), share(),
                            std::vector<std::string>{"left", "right", "middle"}[random() % 3]);
      done += 7;
    } else if (what < 12) {
      script += "key " + keys[random() % keys.size()] + "\n";
      done += 3;
    } else if (what < 14) {
      script += fmt::format("scroll {}\nwait 2\n", random() % 2 ? 1 : -1);
      done += 3;
    } else if (what == 14) {
      script += "drop " + models[random() % models.size()] + "\nwait 6\n";
      done += 7;
    } else {
      script += fmt::format("resize {} {}\n", 400 + random() % 160, 380 + random() % 100);
      done += 3;
    }
  }
  return script;
}

class ViewSoak : public testing::Test {
 protected:
  void SetUp() override {
    display_.emplace(XDisplay::start(800, 600));
    if (!display_->has_value()) GTEST_SKIP() << "Xvfb is not installed";
    scratch_.write("tetra.off",
                   "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    scratch_.write("broken.ply", "ply\nnonsense");
    sample::MovingBox box;
    box.animate(2, "rotation", sample::MovingBox::kTurns);
    scratch_.write("box.glb", box.glb());
  }

  Result play(int frames) const {
    scratch_.write("script.txt", randomScript(frames) + "wait rest\nkey ctrl+shift+p\nwait rest\n");
    return scratch_.run({"view", "stone", "--debug", "--window", "480x460", "--play", "script.txt"},
                        {{"DISPLAY", (*display_)->name()},
                         {"WAYLAND_DISPLAY", ""},
                         {"XDG_CONFIG_HOME", (scratch_ / "config").string()}});
  }

  Scratch scratch_;

 private:
  std::optional<std::optional<XDisplay>> display_;
};

TEST_F(ViewSoak, RandomHandsLeaveNoErrorNoNanAndNoGrowth) {
  const Result warm = play(soakFrames() / 3);
  ASSERT_EQ(warm.status, 0) << warm.err;
  const Result whole = play(soakFrames());
  ASSERT_EQ(whole.status, 0) << whole.err;
  EXPECT_LT(double(whole.peakBytes), double(warm.peakBytes) + kAllowedGrowth);
  int pictures = 0;
  for (const std::string& name : scratch_.names()) {
    if (!name.ends_with(".exr")) continue;
    ++pictures;
    const Image image = readImage(scratch_ / name);
    for (size_t i = 0; i < image.pixelCount(); ++i)
      for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(image.rgb(i)[c])) << name;
  }
  EXPECT_EQ(pictures, 2);
}

}  // namespace
}  // namespace lychnite::e2e
