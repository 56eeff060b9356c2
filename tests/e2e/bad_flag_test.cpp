// Flags that make no sense: one line that names the thing, status 2, nothing written and no time spent.
#include <gtest/gtest.h>

#include "e2e/runner.h"

namespace lychnite::e2e {
namespace {

struct BadFlags {
  const char* name;
  std::vector<std::string> arguments;
  const char* words;
};

void PrintTo(const BadFlags& flags, std::ostream* out) {
  *out << flags.name;
}

class BadFlagTest : public testing::TestWithParam<BadFlags> {};

TEST_P(BadFlagTest, IsRefusedInOneLine) {
  const Scratch scratch;
  const Result result = scratch.run(GetParam().arguments);
  expectOneLine(result, 2, GetParam().words);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(scratch.names().empty());
}

/// A good command line with something wrong added.
BadFlags bad(const char* name, const std::vector<std::string>& more, const char* words) {
  std::vector<std::string> arguments{"render", "stone", "--size", "10mm", "-o", "out.png"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return {name, arguments, words};
}

BadFlags badSize(const char* name, const std::string& size) {
  return {name, {"render", "stone", "--size", size, "-o", "out.png"}, "--size"};
}

std::vector<BadFlags> materialFlags() {
  return {bad("NegativeSigma", {"--sigma-s", "-1", "--sigma-a", "0.1"}, "sigma_s"),
          bad("NegativeAbsorption", {"--sigma-s", "1", "--sigma-a", "-0.1"}, "sigma_a"),
          bad("NanSigma", {"--sigma-s", "nan", "--sigma-a", "0.1"}, "sigma"),
          bad("InfiniteSigma", {"--sigma-s", "inf", "--sigma-a", "0.1"}, "sigma"),
          bad("SigmaOfTwoNumbers", {"--sigma-s", "1,2", "--sigma-a", "0.1"}, "--sigma-s"),
          bad("SigmaAlone", {"--sigma-s", "1"}, "--sigma-a"),
          bad("EtaBelowOne", {"--eta", "0.9"}, "eta"),
          bad("EtaNan", {"--eta", "nan"}, "eta"),
          bad("GOfOne", {"--g", "1"}, "g"),
          bad("GOfMinusOne", {"--g", "-1"}, "g"),
          bad("GNan", {"--g", "nan"}, "g"),
          bad("Roughness", {"--roughness", "-1"}, "roughness"),
          bad("UnknownMaterial", {"--material", "marbel"}, "'marble'")};
}

std::vector<BadFlags> otherFlags() {
  return {badSize("SizeZero", "0mm"),
          badSize("SizeZeroWithoutUnit", "0"),
          badSize("SizeNegative", "-3mm"),
          bad("CellsZero", {"--method", "volume", "--cells", "0"}, "--cells"),
          bad("CellsTooFew", {"--method", "volume", "--cells", "7"}, "cells"),
          {"SizeWithoutUnit", {"render", "stone", "--size", "20", "-o", "out.png"}, "did you mean 20mm?"},
          badSize("SizeNan", "nanmm"),
          badSize("SizeInfinite", "infmm"),
          {"SizeMissing", {"render", "stone", "-o", "out.png"}, "--size"},
          {"ModelMissing", {"render", "--size", "10mm", "-o", "out.png"}, "MODEL"},
          {"OutputMissing", {"render", "stone", "--size", "10mm"}, "--output"},
          {"OutputFormat", {"render", "stone", "--size", "10mm", "-o", "x.bmp"}, "x.bmp"},
          bad("HugeMap", {"--map", "100000"}, "map"),
          bad("MapNotWhole", {"--map", "512.5"}, "--map"),
          bad("ResolutionZero", {"--resolution", "0x0"}, "--resolution"),
          bad("ResolutionHuge", {"--resolution", "1000000x1000000"}, "esolution"),
          bad("ResolutionWords", {"--resolution", "big"}, "--resolution"),
          bad("UnknownMethod", {"--method", "adaptve"}, "adaptive"),
          bad("UnknownProfile", {"--profile", "dipol"}, "dipole"),
          bad("UnknownComponent", {"--components", "multiple,singel"}, "singel"),
          bad("UnknownAov", {"--aov", "dept"}, "dept"),
          bad("UnknownFlag", {"--materail", "marble"}, "'--material'"),
          bad("UnknownToneMap", {"--tone-map", "flimic"}, "--tone-map"),
          bad("Bits", {"--bits", "12"}, "--bits"),
          bad("FramesZero", {"--frames", "0"}, "frames"),
          bad("FramesWords", {"--frames", "three"}, "--frames"),
          bad("OnlySizeFrom", {"--frames", "3", "--size-from", "1mm"}, "--size-to"),
          bad("LightNonsense", {"--light", "nonsense"}, "--light"),
          bad("LightInsideTheObject", {"--light", "point:0mm,0mm,0mm"}, "light 1"),
          bad("CameraNonsense", {"--camera", "orbit:1"}, "--camera"),
          bad("DeviceNonsense", {"--device", "toaster"}, "toaster"),
          bad("Threads", {"--threads", "-1"}, "threads"),
          bad("SamplesNan", {"--method", "walk", "--samples", "nan"}, "samples"),
          {"UnknownCommand", {"rendr", "stone"}, "there is no command 'rendr'; did you mean 'render'?"},
          {"FarFromAnyCommand", {"xyzzyplugh"}, "there is no command 'xyzzyplugh'"},
          bad("DeviceBeyondTheList", {"--device", "99"}, "99"),
          bad("SeedNegative", {"--seed", "-1"}, "--seed"),
          bad("TimeWithoutUnit", {"--method", "walk", "--time", "60"}, "--time"),
          bad("InterpolationAboveOne", {"--interpolation", "150%"}, "interpolation"),
          bad("InterpolationNan", {"--interpolation", "nan"}, "interpolation"),
          bad("MapTooSmall", {"--map", "64"}, "64"),
          bad("CameraFov", {"--camera", "orbit:0,0,1,200"}, "fov"),
          bad("BackgroundNegative", {"--background", "-1"}, "background"),
          bad("LightAngleNan", {"--light", "parallel:nan,3"}, "--light"),
          bad("PointLightWithoutUnits", {"--light", "point:1,2,3"}, "--light"),
          bad("SizeSweepFromZero", {"--size-from", "0mm", "--size-to", "1mm"}, "--size-from"),
          {"SlabThickness", {"slab", "--material", "marble", "--thickness", "2"}, "--thickness"},
          {"NoCommand", {}, "--help"},
          {"SlabWithoutMaterial", {"slab"}, "--sigma-s"},
          {"SlabPhotons", {"slab", "--material", "marble", "--photons", "0"}, "--photons"},
          {"SlabG", {"slab", "--material", "marble", "--g", "2"}, "g: "},
          {"HeatmapFormat", {"compare", "a.exr", "b.exr", "--heatmap", "x.bmp"}, "x.bmp"},
          {"BenchMethods", {"bench", "--methods", "adaptive,walk"}, "'walk'"},
          {"BenchMethodUnknown", {"bench", "--methods", "matchd"}, "matched"},
          {"BenchMethodsNone", {"bench", "--methods", ""}, "--methods"},
          {"BenchModels", {"bench", "--models", "nowhere"}, "--models"},
          {"BenchFrames", {"bench", "--frames", "0"}, "--frames"},
          {"BenchWarmUp", {"bench", "--warm-up", "many"}, "--warm-up"},
          {"BenchDevice", {"bench", "--device", "toaster"}, "toaster"},
          {"BenchJson", {"bench", "--json", "none/b.json"}, "--json"},
          {"BenchQuick", {"bench", "--quik"}, "'--quick'"},
          {"CompareOneFile", {"compare", "a.exr"}, "B"}};
}

const auto kName = [](const auto& test) { return std::string(test.param.name); };
INSTANTIATE_TEST_SUITE_P(Material, BadFlagTest, testing::ValuesIn(materialFlags()), kName);
INSTANTIATE_TEST_SUITE_P(Other, BadFlagTest, testing::ValuesIn(otherFlags()), kName);

TEST(BadOutput, MissingFolder) {
  const Scratch scratch;
  const Result result = scratch.run(renderArguments("stone", {"--size", "10mm", "-o", "none/out.png"}));
  expectOneLine(result, 1, "none");
  EXPECT_TRUE(scratch.names().empty());
}

TEST(BadOutput, Folder) {
  const Scratch scratch;
  std::filesystem::create_directory(scratch / "out.png");
  const Result result = scratch.run(renderArguments("stone", {"--size", "10mm", "-o", "out.png"}));
  expectOneLine(result, 1, "out.png");
  EXPECT_EQ(scratch.names(), std::set<std::string>{"out.png"});
  EXPECT_TRUE(std::filesystem::is_empty(scratch / "out.png"));
}

TEST(BadOutput, StatsIntoAMissingFolderIsSaidBeforeTheWork) {
  const Scratch scratch;
  const Result result = scratch.run(
      renderArguments("stone", {"--size", "10mm", "-o", "out.png", "--stats", "none/stats.json"}));
  expectOneLine(result, 1, "none");
  EXPECT_TRUE(scratch.names().empty());
}

TEST(BadInput, ComparePicturesOfDifferentSizes) {
  const Scratch scratch;
  for (const char* resolution : {"16x16", "16x17"}) {
    const Result result =
        scratch.run({"render", "stone", "--size", "10mm", "--method", "adaptive", "--map", "128",
                     "--resolution", resolution, "-o", std::string(resolution) + ".exr"});
    ASSERT_EQ(result.status, 0) << result.err;
  }
  expectOneLine(scratch.run({"compare", "16x16.exr", "16x17.exr", "--heatmap", "x.png"}), 1, "16 x 17");
  EXPECT_EQ(scratch.names(), (std::set<std::string>{"16x16.exr", "16x17.exr"}));
}

TEST(BadInput, ComparePicturesThatAreNone) {
  const Scratch scratch;
  scratch.write("a.exr", "no picture");
  expectOneLine(scratch.run({"compare", "a.exr", "a.exr"}), 1, "a.exr");
  expectOneLine(scratch.run({"compare", "b.exr", "b.exr"}), 1, "b.exr");
  EXPECT_EQ(scratch.names(), std::set<std::string>{"a.exr"});
}

}  // namespace
}  // namespace lychnite::e2e
