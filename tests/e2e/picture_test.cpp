// File in, pixels out: what `render` writes, and that it means the scene it was given.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "e2e/runner.h"
#include "lychnite/app/image_maker.h"
#include "lychnite/image/io.h"

namespace lychnite::e2e {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

/// Renders and reads back; fails the test when the program fails.
Image rendered(const Scratch& scratch, const std::string& model, Words more, const std::string& output) {
  more.insert(more.end(), {"-o", output});
  const Result result = scratch.run(renderArguments(model, more));
  EXPECT_EQ(result.status, 0) << result.err;
  return readImage(scratch / output);
}

double mean(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += double(v);
  return sum / double(values.size());
}

TEST(Picture, ExrCarriesWhatMadeItAndCoverage) {
  const Scratch scratch;
  const Image image = rendered(scratch, "sphere", {"--size", "10mm"}, "out.exr");
  EXPECT_EQ(image.width(), 64);
  EXPECT_EQ(image.height(), 64);
  EXPECT_EQ(image.metadata.at("method"), "adaptive");
  EXPECT_EQ(image.metadata.at("lychnite"), versionText());
  EXPECT_NE(image.metadata.at("scene").find("sphere"), std::string::npos);
  const std::vector<float>& alpha = image.channel("A");
  EXPECT_EQ(alpha.front(), 0);
  EXPECT_EQ(alpha[32 * 64 + 32], 1);
  const auto partly = std::count_if(alpha.begin(), alpha.end(), [](float a) { return a > 0 && a < 1; });
  EXPECT_GT(partly, 20) << "silhouettes are not anti-aliased";
  EXPECT_GT(mean(alpha), 0.3);
  EXPECT_GT(image.rgb(32 * 64 + 32).x, 0.05f);
}

TEST(Picture, PngCarriesWhatMadeIt) {
  const Scratch scratch;
  const Image image = rendered(scratch, "sphere", {"--size", "10mm", "--transparent"}, "out.png");
  EXPECT_EQ(image.width(), 64);
  EXPECT_EQ(image.metadata.at("method"), "adaptive");
  EXPECT_TRUE(image.metadata.contains("scene"));
  EXPECT_EQ(image.channel("A").front(), 0);
  EXPECT_EQ(image.channel("A")[32 * 64 + 32], 1);
  EXPECT_EQ(scratch.names(), std::set<std::string>{"out.png"});
}

TEST(Picture, AovsAreLayersThatAddUp) {
  const Scratch scratch;
  const Image image = rendered(
      scratch, "stone", {"--size", "10mm", "--aov", "multiple,single,surface,depth,normal"}, "out.exr");
  for (const char* name : {"depth.Z", "normal.X", "normal.Y", "normal.Z"})
    EXPECT_TRUE(image.has(name)) << name;
  double worst = 0;
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    const glm::vec3 sum = image.rgb(i, "multiple") + image.rgb(i, "single") + image.rgb(i, "surface");
    worst = std::max(worst, double(glm::distance(sum, image.rgb(i))));
  }
  EXPECT_LT(worst, 1e-3);
}

TEST(Picture, StatsKeys) {
  const Scratch scratch;
  rendered(scratch, "stone", {"--size", "10mm", "--stats", "stats.json"}, "out.exr");
  const Json stats = Json::parse(scratch.read("stats.json"));
  for (const char* key : {"lychnite",       "method",    "profile",           "components",     "width",
                          "height",         "seconds",   "peak_memory_bytes", "device",         "driver",
                          "software",       "triangles", "vertices",          "covered_pixels", "map_size",
                          "single_samples", "map_bytes", "gpu_bytes",         "frame_ms",       "passes",
                          "metadata"})
    EXPECT_TRUE(stats.contains(key)) << key;
  EXPECT_EQ(stats["width"], 64);
  EXPECT_EQ(stats["map_size"], 128);
  EXPECT_EQ(stats["triangles"], 1114);
  EXPECT_GT(stats["seconds"], 0);
  for (const Json& pass : stats["passes"]) EXPECT_TRUE(pass.contains("name") && pass.contains("gpu_ms"));
  EXPECT_FALSE(stats["passes"].empty());
}

TEST(Picture, FramesAreNumbered) {
  const Scratch scratch;
  const Result result = scratch.run(renderArguments(
      "stone", {"--frames", "3", "--size-from", "1mm", "--size-to", "100mm", "-o", "sweep.exr"}));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(scratch.names(), (std::set<std::string>{"sweep_0001.exr", "sweep_0002.exr", "sweep_0003.exr"}));
  const Image middle = readImage(scratch / "sweep_0002.exr");
  const Image alone = rendered(scratch, "stone", {"--size", "10mm"}, "alone.exr");
  EXPECT_LT(relativeDifference(middle, alone), 1e-4);
  EXPECT_GT(relativeDifference(readImage(scratch / "sweep_0001.exr"), alone), 0.05);
}

TEST(Picture, SavedSceneGivesTheSamePicture) {
  const Scratch scratch;
  const Image first =
      rendered(scratch, "stone",
               {"--size", "7mm", "--material", "skin1", "--eta", "1.4", "--light", "parallel:150,20,2,3,4",
                "--light", "point:3cm,2cm,1cm", "--camera", "orbit:20,10,2.5,30", "--background",
                "0.1,0.2,0.3", "--rotate", "10,20,30", "--save-scene", "scene.toml"},
               "first.exr");
  const Image second = rendered(scratch, "scene.toml", {}, "second.exr");
  EXPECT_LT(relativeDifference(second, first), 1e-6);
}

// Only the time it took differs between the files.
TEST(Picture, SameSeedSamePixelsWhateverTheThreads) {
  const Scratch scratch;
  const Words flags{"--size", "10mm", "--method", "walk", "--samples", "1", "--threads"};
  Words one = flags, two = flags, other = flags;
  one.push_back("1");
  two.push_back("2");
  other.insert(other.end(), {"2", "--seed", "2"});
  const Image a = rendered(scratch, "stone", one, "a.exr");
  EXPECT_TRUE(a.channels() == rendered(scratch, "stone", two, "b.exr").channels());
  EXPECT_FALSE(a.channels() == rendered(scratch, "stone", other, "c.exr").channels());
}

class SizeInvariance : public testing::TestWithParam<const char*> {};

// Lengths times ten and coefficients over ten is the same physics, so the same picture within rounding.
TEST_P(SizeInvariance, TenTimesTheSizeATenthOfTheCoefficients) {
  const Scratch scratch;
  const Words method{"--method", GetParam(), "--g", "0", "--eta", "1.4"};
  Words small = method, large = method;
  small.insert(small.end(), {"--size", "8mm", "--sigma-s", "2,3,4", "--sigma-a", "0.01,0.02,0.1"});
  large.insert(large.end(), {"--size", "80mm", "--sigma-s", "0.2,0.3,0.4", "--sigma-a", "0.001,0.002,0.01"});
  const Image a = rendered(scratch, "stone", small, "a.exr");
  EXPECT_LT(relativeDifference(rendered(scratch, "stone", large, "b.exr"), a), 1e-3);
  large[7] = "40mm";
  ASSERT_EQ(large[6], "--size");
  EXPECT_GT(relativeDifference(rendered(scratch, "stone", large, "c.exr"), a), 1e-2) << "size has no effect";
}

INSTANTIATE_TEST_SUITE_P(Methods, SizeInvariance, testing::Values("matched", "adaptive", "fixed"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace lychnite::e2e
