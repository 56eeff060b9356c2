// Random hands on the viewer. LYCHNITE_SOAK_FRAMES=20000 makes it a long one (ctest label soak, nightly);
// LYCHNITE_SOAK_LOG=FILE then writes the memory and the pictures so far every 20 s.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>

#include "e2e/runner.h"
#include "e2e/x_display.h"
#include "lychnite/image/io.h"
#include "unit/mesh/moving_box.h"

namespace lychnite::e2e {
namespace {

/// The most memory resident may be by so much more in the last third of the run than in the one before;
/// caches, history and the driver's pools are full by then. `volume` holds a solver on either side of the
/// wipe, 80 to 150 MB each, and a third may happen to have one more of them.
constexpr double kAllowedGrowth = 300e6;
constexpr int kPart = 300;     // frames with a method
constexpr int kPicture = 500;  // frames until the next picture is written

int soakFrames() {
  const char* text = std::getenv("LYCHNITE_SOAK_FRAMES");
  return text ? std::max(90, std::atoi(text)) : 180;
}

/// Random numbers and the events that they choose; `frames` counts what they stand for.
class Chance {
 public:
  int frames = 0;

  std::string event() {
    const unsigned what = below(16);
    if (what < 5) return took(7, slide());
    if (what < 8) return took(7, turn());
    if (what < 12) return took(3, key());
    if (what < 14) return took(3, fmt::format("scroll {}\nwait 2\n", below(2) ? 1 : -1));
    if (what == 14) return took(7, "drop " + oneOf(kModels) + "\nwait 6\n");
    return took(3, fmt::format("resize {} {}\n", 400 + below(240), 320 + below(140)));
  }
  /// The next method, the walk or the variant beside it, and long enough for solvers to begin.
  std::string part() {
    return took(72, "key m\nresize 480 1100\nkey d\nkey c\nwait 2\nclick @right\nwait 2\nclick @right-" +
                        oneOf({"truth-walk", "variant", "variant"}) + "\nresize 480 400\nwait 40\n");
  }
  /// Nothing moves by itself any more.
  std::string end() const { return std::string(orbits_ ? "key space\n" : "") + "drop stone\nwait 30\n"; }

 private:
  using Names = std::vector<std::string>;
  inline static const Names kSliders{"sigma-s-r", "sigma-a-g", "sigma-s-b", "g",
                                     "index",     "roughness", "size"};
  inline static const Names kKeys{
      "[", "]", "f", "1", "3", "5", "7", "g", "c", "d", "i", "p", "space", "ctrl+z", "ctrl+shift+z", "h"};
  inline static const Names kModels{"sphere", "stone",     "knot",    "slab",
                                    "disc",   "tetra.off", "box.glb", "broken.ply"};

  unsigned below(unsigned n) { return unsigned(random_()) % n; }
  double share() { return below(1000) / 1000.0; }
  std::string oneOf(const Names& names) { return names[below(unsigned(names.size()))]; }
  std::string took(int count, std::string events) {
    frames += count;
    return events;
  }
  std::string slide() {
    const std::string slider = oneOf(kSliders);
    const double from = share();
    return fmt::format("drag @{0}:{1},0.5 @{0}:{2},0.5 left 3\n", slider, from, share());
  }
  std::string turn() {
    const double a = share(), b = share(), c = share(), d = share();
    return fmt::format("drag @picture:{},{} @picture:{},{} {} 3\n", a, b, c, d,
                       oneOf({"left", "right", "middle"}));
  }
  std::string key() {
    const std::string chosen = oneOf(kKeys);
    if (chosen == "space") orbits_ = !orbits_;
    return "key " + chosen + "\n";
  }

  std::mt19937 random_{7};
  bool orbits_ = false;
};

/// A list of input events that stands for about so many frames. It writes third1.png and third2.png after
/// each third.
std::string randomScript(int frames) {
  // Small maps, because software OpenGL takes a second for large ones.
  std::string script =
      "wait rest\nresize 480 1100\nclick @section-light\nclick @section-picture\nwait 2\nclick @map\n"
      "wait 2\nclick @map-256-x-256\nwait 2\nclick @section-picture\nclick @section-compare\nwait 2\n";
  Chance chance;
  for (int part = 0, picture = 0, third = 0; chance.frames < frames;) {
    if (chance.frames / kPart > part) {
      ++part;
      script += chance.part();
    }
    if (chance.frames / kPicture > picture) {
      ++picture;
      script += "key ctrl+shift+p\n";
    }
    if (3 * chance.frames / frames > third) script += fmt::format("screenshot third{}.png\n", ++third);
    script += chance.event();
  }
  return script + chance.end() + "wait rest\nkey ctrl+shift+p\nwait rest\n";
}

class ViewSoak : public testing::Test {
 protected:
  void SetUp() override {
    display_.emplace(XDisplay::start(800, 1200));
    if (!display_->has_value()) GTEST_SKIP() << "Xvfb is not installed";
    scratch_.write("tetra.off",
                   "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    scratch_.write("broken.ply", "ply\nnonsense");
    sample::MovingBox box;
    box.animate(2, "rotation", sample::MovingBox::kTurns);
    scratch_.write("box.glb", box.glb());
  }

  Result play(int frames) {
    scratch_.write("script.txt", randomScript(frames));
    return scratch_.watch(
        {"view", "stone", "--method", "matched", "--debug", "--window", "480x400", "--play", "script.txt"},
        {{"DISPLAY", (*display_)->name()},
         {"WAYLAND_DISPLAY", ""},
         {"XDG_CONFIG_HOME", (scratch_ / "config").string()}},
        [this](size_t bytes) { look(double(bytes)); });
  }

  std::vector<std::string> pictures() const {
    std::vector<std::string> found;
    for (const std::string& name : scratch_.names())
      if (name.ends_with(".exr") && name[0] != '.') found.push_back(name);
    return found;
  }

  Scratch scratch_;
  std::array<double, 3> most_{};  // bytes resident, of each third

 private:
  void look(double bytes) {
    const auto names = scratch_.names();
    const size_t third = size_t(names.contains("third1.png")) + size_t(names.contains("third2.png"));
    most_[third] = std::max(most_[third], bytes);
    const char* log = std::getenv("LYCHNITE_SOAK_LOG");
    if (log && looks_++ % 20 == 0)
      std::ofstream(log, std::ios::app) << fmt::format("{} s: third {}, {:.0f} MB, {} pictures\n", looks_,
                                                       third + 1, bytes / 1e6, pictures().size());
  }

  std::optional<std::optional<XDisplay>> display_;
  int looks_ = 0;
};

TEST_F(ViewSoak, RandomHandsLeaveNoErrorNoNanAndNoGrowth) {
  const Result result = play(soakFrames());
  ASSERT_EQ(result.status, 0) << result.err;
  for (const auto& bytes : most_) EXPECT_GT(bytes, 0);
  EXPECT_LT(most_[2], std::max(most_[0], most_[1]) + kAllowedGrowth);
  const auto written = pictures();
  EXPECT_GE(int(written.size()),
            1 + soakFrames() / kPicture / 2);  // a scene may be one that no method draws
  for (const std::string& name : written) {
    const Image image = readImage(scratch_ / name);
    for (size_t i = 0; i < image.pixelCount(); ++i)
      for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(image.rgb(i)[c])) << name;
  }
}

}  // namespace
}  // namespace lychnite::e2e
