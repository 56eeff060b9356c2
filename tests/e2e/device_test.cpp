// Machines without OpenGL, and users who change their mind.
#include <gtest/gtest.h>

#include "e2e/runner.h"
#include "lychnite/image/io.h"

namespace lychnite::e2e {
namespace {

// The loader of EGL drivers finds none in a folder that does not exist.
const Environment kNoEgl{{"__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent"}, {"EGL_PLATFORM", ""}};

TEST(Device, ListNamesTheRenderer) {
  const Scratch scratch;
  const Result result = scratch.run({"devices"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("OpenGL 4."), std::string::npos) << result.out;
}

TEST(Device, WithoutEglRealTimeMethodsSaySo) {
  const Scratch scratch;
  const Result result = scratch.run(
      renderArguments("stone", {"--size", "10mm", "--method", "matched", "-o", "out.png"}), kNoEgl);
  expectOneLine(result, 3, "EGL");
  EXPECT_TRUE(scratch.names().empty());
  expectOneLine(scratch.run({"devices"}, kNoEgl), 3, "EGL");
}

TEST(Device, WithoutEglTheJudgesWork) {
  const Scratch scratch;
  const Result result = scratch.run(
      renderArguments("stone", {"--size", "10mm", "--method", "walk", "--samples", "1", "-o", "out.exr"}),
      kNoEgl);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(readImage(scratch / "out.exr").metadata.at("method"), "walk");
}

TEST(Device, WithoutShadersRealTimeMethodsSaySo) {
  const Scratch scratch;
  const Result result = scratch.run(renderArguments("stone", {"--size", "10mm", "-o", "out.png"}),
                                    {{"LYCHNITE_SHADER_DIR", "/nonexistent"}});
  expectOneLine(result, 3, "/nonexistent");
  EXPECT_TRUE(scratch.names().empty());
}

// Whenever the interrupt comes, the picture is there whole or not at all: at once, and when there is
// something to keep.
TEST(Interrupt, LeavesAWholePictureOrNone) {
  for (const double seconds : {0.0, 1.5}) {
    const Scratch scratch;
    const Result result = scratch.runAndInterrupt(
        renderArguments("stone",
                        {"--size", "10mm", "--method", "walk", "--samples", "100000", "-o", "out.exr"}),
        seconds);
    expectOneLine(result, 130, "interrupted");
    if (scratch.names().empty()) continue;
    EXPECT_EQ(scratch.names(), std::set<std::string>{"out.exr"});
    EXPECT_EQ(readImage(scratch / "out.exr").width(), 64);
  }
}

TEST(Interrupt, StopsWithinAFrame) {
  const Scratch scratch;
  const Result result =
      scratch.runAndInterrupt(renderArguments("stone", {"--size", "10mm", "--method", "walk", "--samples",
                                                        "100000", "--frames", "3", "-o", "out.exr"}),
                              0.5);
  expectOneLine(result, 130, "interrupted");
  for (const std::string& name : scratch.names()) EXPECT_EQ(name, "out_0001.exr");
}

}  // namespace
}  // namespace lychnite::e2e
