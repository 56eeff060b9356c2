// `render --method volume` as a user meets it.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cstdlib>

#include "e2e/runner.h"
#include "lychnite/image/io.h"

namespace lychnite::e2e {
namespace {

TEST(Volume, AMeshWithoutAnInsideIsRenderedByMatchedAndSaysSo) {
  const Scratch scratch;
  const Result result =
      scratch.run(renderArguments("disc", {"--size", "10mm", "--method", "volume", "-o", "out.exr"}));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("warning: volume: the mesh of disc is open"), std::string::npos) << result.err;
  const Image image = readImage(scratch / "out.exr");
  EXPECT_EQ(image.metadata.at("fallback").rfind("matched: the mesh of disc", 0), 0u);
}

TEST(Volume, NoiseStopsItAndIsALayer) {
  const Scratch scratch;
  const auto noiseAt = [&](const char* wanted) {
    const Result result = scratch.run(
        renderArguments("stone", {"--size", "5mm", "--method", "volume", "--cells", "16", "--collisions", "3",
                                  "--noise", wanted, "--aov", "stderr", "-o", "out.exr"}));
    EXPECT_EQ(result.status, 0) << result.err;
    const Image image = readImage(scratch / "out.exr");
    EXPECT_GT(image.rgb(32 * 64 + 32, "stderr").x, 0);
    return std::strtod(image.metadata.at("noise").c_str(), nullptr);
  };
  const double rough = noiseAt("100%");
  EXPECT_GT(rough, 0);
  const double fine = noiseAt(fmt::format("{:.4f}%", 70 * rough).c_str());
  EXPECT_LE(fine, 0.7 * rough);
}

}  // namespace
}  // namespace lychnite::e2e
