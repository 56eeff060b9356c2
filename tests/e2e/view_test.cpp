// The viewer's real window, driven by recorded input on an X server without a screen.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "e2e/runner.h"
#include "e2e/x_display.h"
#include "lychnite/image/io.h"
#include "lychnite/scene/scene_file.h"
#include "unit/mesh/moving_box.h"

namespace lychnite::e2e {
namespace {

constexpr int kWidth = 480, kHeight = 360;                // of the window
constexpr int kPictureWidth = 240, kPictureHeight = 296;  // the panel takes half, the size bar 64
constexpr char kTetrahedron[] =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

class View : public testing::Test {
 protected:
  void SetUp() override {
    display_.emplace(XDisplay::start(1600, 1200));
    if (!display_->has_value()) GTEST_SKIP() << "Xvfb is not installed";
  }

  /// Runs the viewer with a debug context, so that any OpenGL error ends it with a status other than 0.
  Result view(std::vector<std::string> arguments, const Environment& more = {}) const {
    arguments.insert(arguments.begin(), "view");
    for (const char* word : {"--debug", "--verbose", "--window"}) arguments.emplace_back(word);
    arguments.push_back(std::to_string(kWidth) + "x" + std::to_string(kHeight));
    Environment environment{{"DISPLAY", (*display_)->name()},
                            {"WAYLAND_DISPLAY", ""},
                            {"XDG_CONFIG_HOME", (scratch_ / "config").string()}};
    for (const auto& [name, value] : more) environment[name] = value;
    return scratch_.run(arguments, environment);
  }

  /// By a method that is drawn at once; volume has tests of its own.
  Result play(const std::string& model, const std::string& script,
              const std::string& method = "matched") const {
    scratch_.write("script.txt", script);
    return view({model, "--method", method, "--play", "script.txt"});
  }

  Image shot(const std::string& name) const { return readImage(scratch_ / name); }

  Scratch scratch_;

 private:
  std::optional<std::optional<XDisplay>> display_;
};

/// The picture's part of the window: left of the panel, above the size bar.
struct Part {
  double x0 = 0, y0 = 0, x1 = 1, y1 = 1;  // shares of the picture
};

/// Mean absolute difference of display values, 0 to 255, over a part of the picture.
double difference(const Image& a, const Image& b, const Part& part = {}) {
  double sum = 0;
  int count = 0;
  for (int y = int(part.y0 * kPictureHeight); y < int(part.y1 * kPictureHeight); ++y) {
    for (int x = int(part.x0 * kPictureWidth); x < int(part.x1 * kPictureWidth); ++x) {
      const size_t i = size_t(y) * size_t(a.width()) + size_t(x);
      for (int c = 0; c < 3; ++c)
        sum += 255 * std::abs(double(srgbFromLinear(a.rgb(i)[c])) - double(srgbFromLinear(b.rgb(i)[c])));
      count += 3;
    }
  }
  return sum / count;
}

TEST_F(View, ScreenshotIsTheFirstWholePicture) {
  const Result result = view({"stone", "--method", "matched", "--screenshot", "window.png"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Image window = shot("window.png");
  ASSERT_EQ(window.width(), kWidth);
  ASSERT_EQ(window.height(), kHeight);
  // The stone in the middle of the picture is lit, its corner is the dark background.
  const auto at = [&](int x, int y) { return window.rgb(size_t(y) * kWidth + size_t(x)); };
  EXPECT_GT(at(120, 148).g, 0.05f);
  EXPECT_LT(at(5, 5).g, 0.03f);
}

TEST_F(View, ASavedSceneRendersToTheSamePicture) {
  const Result result = play(
      "stone", "wait rest\nkey g\nwait rest\nscreenshot window.png\nkey ctrl+s\nkey ctrl+p\nwait rest\n");
  ASSERT_EQ(result.status, 0) << result.err;
  const Result rendered =
      scratch_.run({"render", "stone.toml", "--method", "matched", "--resolution",
                    fmt::format("{}x{}", kPictureWidth, kPictureHeight), "-o", "again.png"});
  ASSERT_EQ(rendered.status, 0) << rendered.err;
  EXPECT_EQ(scratch_.read("stone.png"), scratch_.read("again.png"));
  // What the window shows is that picture, to a step of its 8 bits.
  const Image window = shot("window.png"), again = shot("again.png");
  double worst = 0;
  for (int y = 0; y < kPictureHeight; ++y)
    for (int x = 0; x < kPictureWidth; ++x)
      for (int c = 0; c < 3; ++c)
        worst = std::max(
            worst,
            std::abs(255 * double(srgbFromLinear(window.rgb(size_t(y) * kWidth + size_t(x))[c])) -
                     255 * double(srgbFromLinear(again.rgb(size_t(y) * kPictureWidth + size_t(x))[c]))));
  EXPECT_LE(worst, 1.01);
}

TEST_F(View, VolumeIsWhatItShowsAndSavesUnasked) {
  scratch_.write("script.txt", "wait rest\nkey ctrl+s\nkey ctrl+p\nwait rest\n");
  const Result result = view({"stone", "--play", "script.txt"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Result rendered =
      scratch_.run({"render", "stone.toml", "--cells", "64", "--resolution",
                    fmt::format("{}x{}", kPictureWidth, kPictureHeight), "-o", "again.png"});
  ASSERT_EQ(rendered.status, 0) << rendered.err;
  EXPECT_EQ(shot("again.png").metadata.at("method"), "volume");
  EXPECT_EQ(scratch_.read("stone.png"), scratch_.read("again.png"));
}

TEST_F(View, DraggingTheSizeChangesTheLightAndCanBeUndone) {
  const Result result = play("stone",
                             "wait rest\nscreenshot before.png\n"
                             "drag @size:0.5,0.5 @size:0.1,0.5\nwait rest\nscreenshot small.png\nkey ctrl+s\n"
                             "key ]\nkey ctrl+z\nkey ctrl+z\nwait rest\nscreenshot after.png\n");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_GT(difference(shot("before.png"), shot("small.png")), 2);
  EXPECT_LT(difference(shot("before.png"), shot("after.png"), {0, 0, 1, 0.7}), 0.01);
  EXPECT_NEAR(readScene(scratch_ / "stone.toml").objects[0].size, 0.3, 0.03);
}

TEST_F(View, ATypedSizeIsTaken) {
  const Result result = play("stone",
                             "wait rest\nclick @size-text\ntype \"2.5 cm\"\nkey enter\nwait 3\n"
                             "click @size-text\ntype nonsense\nkey enter\nwait 3\nkey ctrl+s\n");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(readScene(scratch_ / "stone.toml").objects[0].size, 25);
  EXPECT_NE(result.err.find("nonsense"), std::string::npos) << result.err;
}

TEST_F(View, DroppedFilesAreOpenedAndBadOnesAreNot) {
  scratch_.write("tetra.off", kTetrahedron);
  scratch_.write("broken.ply", "ply\nnonsense");
  const Result result =
      play("stone",
           "wait rest\nscreenshot stone.png\ndrop tetra.off\nwait rest\nscreenshot tetra.png\n"
           "drop broken.ply\nwait rest\nkey ctrl+s\nwait rest\nquit\n");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("broken.ply"), std::string::npos) << result.err;
  EXPECT_GT(difference(shot("stone.png"), shot("tetra.png")), 1);
  EXPECT_EQ(readScene(scratch_ / "tetra.toml").objects[0].model, "tetra.off");
  // What was opened is remembered, and the saved scene opens again.
  EXPECT_NE(scratch_.read("config/lychnite/viewer.toml").find("tetra.off"), std::string::npos);
  ASSERT_EQ(view({"tetra.toml", "--method", "matched", "--screenshot", "again.png"}).status, 0);
  EXPECT_LT(difference(shot("tetra.png"), shot("again.png"), {0, 0, 1, 0.8}), 0.5);  // above the message
}

TEST_F(View, TheWipeShowsTheVariantOnItsRight) {
  const Result result =
      play("stone",
           "key g\nwait rest\nscreenshot before.png\nclick @section-material\nclick @section-light\n"
           "click @section-compare\nwait 2\nkey c\nwait 3\nclick @another-size\n"
           "drag @wipe @picture:0.75,0.9\nwait rest\nscreenshot wipe.png\nkey d\nwait rest\n"
           "screenshot difference.png\n");
  ASSERT_EQ(result.status, 0) << result.err;
  const Image before = shot("before.png"), wipe = shot("wipe.png");
  EXPECT_LT(difference(before, wipe, {0, 0.1, 0.7, 0.9}), 0.01);
  EXPECT_GT(difference(before, wipe, {0.77, 0.3, 1, 0.7}), 0.05);
  EXPECT_GT(difference(before, shot("difference.png"), {0.3, 0.3, 0.7, 0.7}), 5);
  // The colour bar along the lower edge, from its beginning to its end.
  const Image bar = shot("difference.png");
  const int red[] = {0, 81, 183, 252, 252}, blue[] = {4, 124, 121, 97, 191};
  for (int i = 0; i < 5; ++i) {
    const glm::vec3 shown = bar.rgb(size_t(278) * kWidth + size_t(38 + 47 * i));
    EXPECT_NEAR(255 * srgbFromLinear(shown.r), red[i], 12) << i;
    EXPECT_NEAR(255 * srgbFromLinear(shown.b), blue[i], 12) << i;
  }
}

TEST_F(View, TheWalkBecomesAThirdSource) {
  const Result result = play(
      "sphere",
      "resize 320 240\nwait rest\nclick @section-material\nclick @section-light\nclick @section-compare\nkey "
      "c\n"
      "wait 3\nclick @right\nwait 2\nclick @right-truth-walk\nwait 100%\nwait rest\nscreenshot walk.png\n"
      "drag 60,60 90,70\nwait 3\n");
  ASSERT_EQ(result.status, 0) << result.err;
  // The walk on the right lights the sphere as the method on the left does, within reason; not the
  // background.
  const Image window = shot("walk.png");
  const auto luminance = [&](int x) { return window.rgb(size_t(88 * window.width() + x)).g; };
  EXPECT_GT(luminance(100), 0.3 * luminance(60));
  EXPECT_LT(luminance(100), 3 * luminance(60));
}

/// Opens the section about the picture where a small window shows it, and chooses the method.
std::string choosing(const std::string& method) {
  return "wait rest\nclick @section-material\nclick @section-light\nclick @section-picture\nwait 2\n"
         "click @method\nwait 2\nclick @method-" +
         method + "\nwait 3\n";
}

TEST_F(View, VolumeTakesThePlaceOfMatchedWhenItIsSolved) {
  const Result result = play("stone", "key g\nwait rest\nscreenshot matched.png\n" + choosing("volume") +
                                          "drag @cells:0.45,0.5 @cells:0,0.5\nwait rest\n"
                                          "screenshot volume.png\n"
                                          "drag @picture:0.3,0.5 @picture:0.7,0.5 right 12\nwait rest\n"
                                          "screenshot turned.png\ndrop disc\nwait rest\n");
  ASSERT_EQ(result.status, 0) << result.err;
  // Another light inside, but the same object; and an open one has no inside.
  const double changed = difference(shot("matched.png"), shot("volume.png"), {0.2, 0.2, 0.8, 0.8});
  EXPECT_GT(changed, 1);
  EXPECT_LT(changed, 40);
  EXPECT_GT(difference(shot("volume.png"), shot("turned.png"), {0.2, 0.2, 0.8, 0.8}), 1);
  EXPECT_NE(result.err.find("shown by matched instead"), std::string::npos) << result.err;
}

TEST_F(View, TheSamplesUnderTheMouseLightUp) {
  const Result result = play("stone",
                             "key g\nmove @picture:0.9,0.1\nkey i\nwait rest\nscreenshot off.png\n"
                             "move @picture:0.5,0.5\nwait 3\nscreenshot matched.png\n" +
                                 choosing("fixed") +
                                 "move @picture:0.5,0.5\nwait rest\nwait 3\nscreenshot fixed.png\n"
                                 "key i\nwait rest\nscreenshot none.png\n");
  ASSERT_EQ(result.status, 0) << result.err;
  // Off the object nothing shows; on it, the map's inset in the lower left and squares on the stone.
  const Part inset{0.02, 0.7, 0.3, 0.98}, stone{0.3, 0.3, 0.5, 0.5};
  EXPECT_GT(difference(shot("off.png"), shot("matched.png"), inset), 10);
  EXPECT_GT(difference(shot("off.png"), shot("matched.png"), stone), 2);
  EXPECT_GT(difference(shot("none.png"), shot("fixed.png"), inset), 10);
  EXPECT_LT(difference(shot("none.png"), shot("off.png"), inset), 1);
}

TEST_F(View, AnimationsPlayAndAreKeptByTheScene) {
  sample::MovingBox box;
  box.animate(2, "rotation", sample::MovingBox::kTurns, "LINEAR", "bend");
  scratch_.write("box.glb", box.glb());
  EXPECT_NE(scratch_.run({"info", "box.glb"}).out.find("bend, 2 s"), std::string::npos);
  const Result result =
      play("box.glb",
           "key g\nclick @section-material\nclick @section-light\nwait rest\nscreenshot rest.png\n"
           "key p\nwait 60\nkey p\nwait rest\n"
           "screenshot bent.png\nkey ctrl+s\nkey ctrl+p\nwait rest\n"
           "drag @time:0.5,0.5 @time:1,0.5\nwait rest\nscreenshot end.png\nkey ctrl+z\nwait rest\n"
           "screenshot again.png\n");
  ASSERT_EQ(result.status, 0) << result.err;
  const Part upper{0.1, 0.05, 0.9, 0.6};  // above the messages
  EXPECT_GT(difference(shot("rest.png"), shot("bent.png"), upper), 1);
  EXPECT_GT(difference(shot("bent.png"), shot("end.png"), upper), 1);
  EXPECT_LT(difference(shot("bent.png"), shot("again.png"), {0.1, 0.05, 0.9, 0.35}), 0.01);
  const Object kept = readScene(scratch_ / "box.toml").objects[0];
  EXPECT_EQ(kept.clip, "bend");
  EXPECT_NEAR(kept.time, 1, 0.1);  // 60 frames
  const Result rendered =
      scratch_.run({"render", "box.toml", "--resolution", fmt::format("{}x{}", kPictureWidth, kPictureHeight),
                    "--method", "matched", "-o", "rendered.png"});
  ASSERT_EQ(rendered.status, 0) << rendered.err;
  EXPECT_EQ(scratch_.read("box.png"), scratch_.read("rendered.png"));
}

TEST_F(View, APoseThatCannotBeIsToldOnceAndTheLastOneStays) {
  sample::MovingBox box;
  box.animate(2, "scale", sample::MovingBox::kWild, "LINEAR", "burst");
  scratch_.write("box.glb", box.glb());
  const Result result =
      play("box.glb",
           "key g\nclick @section-material\nclick @section-light\nwait rest\nscreenshot rest.png\n"
           "key p\nwait 10\nkey p\nwait 10\ndrag @time:0.1,0.5 @time:0.9,0.5\nwait rest\n"
           "screenshot after.png\nkey ctrl+s\n");
  ASSERT_EQ(result.status, 0) << result.err;
  const size_t first = result.err.find("burst at");
  ASSERT_NE(first, std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("burst at", first + 1), std::string::npos) << result.err;
  EXPECT_LT(difference(shot("rest.png"), shot("after.png"), {0.1, 0.05, 0.9, 0.5}), 0.3);
  EXPECT_EQ(readScene(scratch_ / "box.toml").objects[0].time, 0);
}

TEST_F(View, LightsCameraAndKeysMoveThePicture) {
  const Result result =
      play("stone",
           "wait rest\nscreenshot a.png\ndrag 100,150 160,130\nwait rest\nscreenshot b.png\n"
           "drag 100,150 200,210 right\nwait rest\nscreenshot c.png\nscroll 3\nwait rest\nscreenshot d.png\n"
           "key 3\nkey f\nkey h\nwait rest\nscreenshot e.png\nkey escape\nkey space\nwait 20\nkey space\n");
  ASSERT_EQ(result.status, 0) << result.err;
  for (const auto& [one, other] :
       {std::pair("a", "b"), std::pair("b", "c"), std::pair("c", "d"), std::pair("d", "e")})
    EXPECT_GT(difference(shot(std::string(one) + ".png"), shot(std::string(other) + ".png")), 1) << one;
}

TEST_F(View, ResizesMinimisesAndComesBack) {
  const Result result =
      play("sphere",
           "wait rest\nresize 600 400\nwait rest\nscreenshot large.png\nminimise\nwait 5\nrestore\n"
           "resize 330 250\nwait rest\nscreenshot small.png\n");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(shot("large.png").width(), 600);
  EXPECT_EQ(shot("small.png").height(), 250);
}

TEST_F(View, BrokenSettingsAreSetAside) {
  std::filesystem::create_directories(scratch_ / "config/lychnite");
  scratch_.write("config/lychnite/viewer.toml", "window_width = oops");
  const Result result = view({"sphere", "--method", "matched", "--screenshot", "window.png"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("viewer.toml.broken"), std::string::npos) << result.err;
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "config/lychnite/viewer.toml.broken"));
}

TEST_F(View, TwiceTheScaleIsTwiceAsLarge) {
  const Result result = view({"sphere", "--method", "matched", "--scale", "2", "--screenshot", "window.png"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(shot("window.png").width(), 2 * kWidth);
}

TEST_F(View, MistakesInScriptsAreToldWithTheirLine) {
  expectOneLine(play("sphere", "wait 2\nclik 3,4\n"), 2, "script.txt:2");
  const Result result = play("sphere", "wait rest\nclick @nothing\n");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("script.txt:2"), std::string::npos) << result.err;
}

TEST_F(View, AMissingModelIsAnError) {
  const Result result = view({"none.ply", "--screenshot", "window.png"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("none.ply"), std::string::npos) << result.err;
}

TEST_F(View, AnOldDriverIsToldWhatIsMissing) {
  const Result result = view({"sphere", "--screenshot", "window.png"}, {{"MESA_GL_VERSION_OVERRIDE", "3.3"}});
  if (result.status == 0) GTEST_SKIP() << "this driver's version cannot be lowered";
  expectOneLine(result, 3, "OpenGL 4.5");
}

TEST(ViewWithoutDisplay, SaysSoInOneLine) {
  const Scratch scratch;
  expectOneLine(scratch.run({"view", "sphere"}, {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}}), 3, "display");
}

}  // namespace
}  // namespace lychnite::e2e
