// `render --profile tabulated`: measured on first use, found again, whatever the cache folder is like.
#include <gtest/gtest.h>

#include <fstream>

#include "e2e/runner.h"
#include "lychnite/image/io.h"

namespace lychnite::e2e {
namespace {

/// Skim-milk-like but dark, so that it is measured in a moment.
std::vector<std::string> tabulated(const std::string& method, const std::string& output) {
  return renderArguments("sphere", {"--size", "10mm", "--sigma-s", "0.5,0.4,0.3", "--sigma-a", "0.5,0.6,0.7",
                                    "--light", "parallel:150,20", "--components", "multiple", "--profile",
                                    "tabulated", "--method", method, "-o", output});
}

const Environment kCache{{"XDG_CACHE_HOME", "cache"}};

TEST(TabulatedProfile, ServesEveryMethodThatTakesATable) {
  const Scratch scratch;
  for (const std::string method : {"dipole", "hierarchical", "matched", "adaptive"}) {
    const Result result = scratch.run(tabulated(method, method + ".exr"), kCache);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(readImage(scratch / (method + ".exr")).metadata.at("profile"), "tabulated");
  }
  const Image judge = readImage(scratch / "dipole.exr");
  EXPECT_LT(relativeDifference(readImage(scratch / "hierarchical.exr"), judge), 0.01);
  EXPECT_LT(relativeDifference(readImage(scratch / "matched.exr"), judge), 0.15);
}

TEST(TabulatedProfile, SecondRunReadsTheCacheAndDamageIsRepaired) {
  const Scratch scratch;
  ASSERT_EQ(scratch.run(tabulated("hierarchical", "first.exr"), kCache).status, 0);
  const auto folder = scratch / "cache" / "lychnite";
  const auto file = std::filesystem::directory_iterator(folder)->path();
  const auto written = std::filesystem::last_write_time(file);
  const Result second = scratch.run(tabulated("hierarchical", "second.exr"), kCache);
  EXPECT_EQ(second.status, 0);
  EXPECT_EQ(second.err, "");
  EXPECT_EQ(std::filesystem::last_write_time(file), written);
  EXPECT_EQ(relativeDifference(readImage(scratch / "second.exr"), readImage(scratch / "first.exr")), 0);
  std::ofstream(file) << "{ not a profile";
  const Result third = scratch.run(tabulated("hierarchical", "third.exr"), kCache);
  expectOneLine(third, 0, "is damaged");
  EXPECT_EQ(relativeDifference(readImage(scratch / "third.exr"), readImage(scratch / "first.exr")), 0);
}

TEST(TabulatedProfile, GoesOnWithoutACacheFolder) {
  const Scratch scratch;
  scratch.write("cache", "a file where the folder should be");
  const Result result = scratch.run(tabulated("hierarchical", "out.exr"), kCache);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
}

}  // namespace
}  // namespace lychnite::e2e
