#include "lychnite/gpu/context.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/texture.h"
#include "gpu_test.h"

namespace lychnite::gpu {
namespace {

using ContextTest = GpuTest;

TEST_F(ContextTest, DescribesItsDevice) {
  const DeviceInfo& info = context_->device();
  EXPECT_TRUE(info.usable);
  EXPECT_TRUE(info.problem.empty()) << info.problem;
  EXPECT_FALSE(info.renderer.empty());
  EXPECT_NE(info.version.find("4."), std::string::npos) << info.version;
  EXPECT_GE(maxTextureSize(), 4096);
  EXPECT_GE(maxSamples(), 4);
}

TEST_F(ContextTest, EveryListedDeviceIsUsableOrSaysWhyNot) {
  const std::vector<DeviceInfo> devices = listDevices();
  ASSERT_FALSE(devices.empty());
  for (size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].index, static_cast<int>(i));
    EXPECT_NE(devices[i].usable, !devices[i].problem.empty()) << i;
    if (devices[i].usable) {
      Context chosen({.device = std::to_string(i)});
      EXPECT_EQ(chosen.device().renderer, devices[i].renderer);
    }
  }
}

TEST_F(ContextTest, ListingDevicesLeavesTheContextCurrent) {
  const Texture before({.label = "before", .format = Format::kR32f, .width = 2, .height = 1});
  listDevices();
  Texture after({.label = "after", .format = Format::kR32f, .width = 2, .height = 1});
  after.upload(std::vector<float>{3, 4});
  EXPECT_EQ(after.download(), (std::vector<float>{3, 4}));
}

TEST_F(ContextTest, WrappingTheCurrentContextSharesIt) {
  std::optional<Context> wrapped(ContextOptions{.current = true});
  EXPECT_EQ(wrapped->device().renderer, context_->device().renderer);
  Texture texture({.label = "shared", .format = Format::kR32f, .width = 2, .height = 1});
  EXPECT_EQ(wrapped->allocatedBytes(), context_->allocatedBytes());
  wrapped.reset();
  texture.upload(std::vector<float>{3, 4});
  EXPECT_EQ(texture.download(), (std::vector<float>{3, 4}));
}

TEST(ContextWrapTest, NothingToWrapIsADeviceError) {
  try {
    Context wrapped({.current = true});
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::kDevice);
    EXPECT_NE(std::string(error.what()).find("window"), std::string::npos) << error.what();
  }
}

TEST_F(ContextTest, CpuMeansASoftwareDriver) {
  std::optional<Context> software;
  try {
    software.emplace(ContextOptions{.device = "cpu"});
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
  EXPECT_TRUE(software->device().software) << software->device().renderer;
}

TEST_F(ContextTest, UnknownDevicesAreUsageErrors) {
  EXPECT_EQ(errorOf([] { Context context({.device = "fast"}); }).found, "'fast'");
  EXPECT_EQ(errorOf([] { Context context({.device = "99"}); }).found, "99");
  EXPECT_EQ(errorOf([] { Context context({.device = "-1"}); }).found, "-1");
}

TEST_F(ContextTest, AFailedAttemptLeavesTheContextCurrent) {
  if (!context_->device().software) GTEST_SKIP() << "there is a GPU";
  EXPECT_NE(errorOf([] { Context context({.device = "gpu"}); }).expected.find("a GPU"), std::string::npos);
  Texture texture({.label = "after", .format = Format::kR32f, .width = 1, .height = 1});
  texture.upload(std::vector<float>{5});
  EXPECT_EQ(texture.download(), std::vector<float>{5});
}

TEST_F(ContextTest, ADebugErrorIsReportedOnceWithTheDriversText) {
  Program wrong(fullScreen("pass/add.frag", {{"SCALE", "1.0"}}));
  wrong.set("amount", 1);  // an int for a vec4
  const Error::Parts parts = errorOf([this] { context_->checkErrors("here"); });
  EXPECT_EQ(parts.where, "here");
  EXPECT_NE(parts.found.find(context_->device().renderer), std::string::npos) << parts.found;
  EXPECT_EQ(parts.found.find("reported GL_INVALID_OPERATION ("), std::string::npos) << "the code alone";
  EXPECT_NO_THROW(context_->checkErrors("again"));
}

TEST_F(ContextTest, WithoutDebugTheErrorsCodeIsReported) {
  Context plain({.device = "auto", .debug = false});
  {
    Program wrong(fullScreen("pass/add.frag", {{"SCALE", "1.0"}}));
    wrong.set("amount", 1);
    const Error::Parts parts = errorOf([&] { plain.checkErrors("here"); });
    EXPECT_NE(parts.found.find("GL_INVALID_OPERATION"), std::string::npos) << parts.found;
    EXPECT_NO_THROW(plain.checkErrors("again"));
  }
  context_->makeCurrent();
}

TEST_F(ContextTest, CountsWhatBuffersAndTexturesHold) {
  EXPECT_EQ(context_->allocatedBytes(), 0u);
  {
    Texture texture({.label = "t", .format = Format::kRg32f, .width = 4, .height = 4, .levels = 0});
    EXPECT_EQ(texture.bytes(), 8u * (16 + 4 + 1));
    Buffer buffer("b");
    buffer.upload(std::vector<float>(10));
    EXPECT_EQ(context_->allocatedBytes(), 8u * 21 + 40);
    buffer.upload(std::vector<float>(3));
    EXPECT_EQ(allocatedBytes(), 8u * 21 + 12);
    Texture moved = std::move(texture);
    EXPECT_EQ(allocatedBytes(), 8u * 21 + 12);
    moved = Texture({.label = "multi", .format = Format::kR32f, .width = 2, .height = 2, .samples = 4});
    EXPECT_EQ(allocatedBytes(), 4u * 4 * 4 + 12);
  }
  EXPECT_EQ(context_->allocatedBytes(), 0u);
}

TEST_F(ContextTest, ObjectsGoBackToTheContextThatMadeThem) {
  std::optional<Texture> first(
      std::in_place, TextureDesc{.label = "first", .format = Format::kR32f, .width = 1, .height = 1});
  Context other({.device = "auto", .debug = true});
  Texture second({.label = "second", .format = Format::kR32f, .width = 1, .height = 1});
  second.upload(std::vector<float>{7});
  first.reset();  // same driver's number as `second`, in another context
  EXPECT_EQ(second.download(), std::vector<float>{7});
  EXPECT_EQ(context_->allocatedBytes(), 0u);
  EXPECT_EQ(other.allocatedBytes(), 4u);
  other.checkErrors("other");
}

TEST_F(ContextTest, ObjectsMayOutliveTheirContext) {
  auto other = std::make_unique<Context>(ContextOptions{.device = "auto", .debug = true});
  std::optional<Buffer> buffer(std::in_place, "left over");
  buffer->upload(std::vector<float>{1});
  other.reset();
  buffer.reset();
  context_->makeCurrent();
}

/// These run in a program of their own, because EGL is loaded once a process.
class NoDriver : public ::testing::Test {
 protected:
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }

  /// What the program prints to stderr, and its exit status: 3 for a device error.
  [[noreturn]] static void openAndExit() {
    if (!listDevices().empty()) std::exit(1);
    try {
      Context context;
    } catch (const Error& error) {
      std::fputs(error.what(), stderr);
      std::exit(error.kind() == Error::Kind::kDevice ? 3 : 2);
    }
    std::exit(0);
  }

  /// A folder in which the loader finds `library` first, and finds it empty.
  static std::string folderThatHides(const std::vector<std::string>& libraries) {
    const std::filesystem::path folder = std::string(LYCHNITE_TEST_OUTPUT_DIR) + "/no_" + libraries.front();
    std::filesystem::create_directories(folder);
    for (const std::string& library : libraries) std::ofstream(folder / library).flush();
    return folder.string();
  }
};

TEST_F(NoDriver, NoEglLibraryIsOneClearLine) {
  setenv("LD_LIBRARY_PATH", folderThatHides({"libEGL.so.1"}).c_str(), 1);
  EXPECT_EXIT(openAndExit(), ::testing::ExitedWithCode(3),
              "OpenGL 4.5 core.*libEGL.so.1 cannot be loaded; install");
  unsetenv("LD_LIBRARY_PATH");
}

TEST_F(NoDriver, NoOpenGlLibraryIsOneClearLine) {
  setenv("LD_LIBRARY_PATH", folderThatHides({"libOpenGL.so.0", "libGL.so.1"}).c_str(), 1);
  EXPECT_EXIT(openAndExit(), ::testing::ExitedWithCode(3), "neither libOpenGL.so.0 nor libGL.so.1");
  unsetenv("LD_LIBRARY_PATH");
}

TEST_F(NoDriver, NoEglDriverIsOneClearLine) {
  setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1);
  EXPECT_EXIT(openAndExit(), ::testing::ExitedWithCode(3), "no EGL driver is installed");
  unsetenv("__EGL_VENDOR_LIBRARY_DIRS");
}

}  // namespace
}  // namespace lychnite::gpu
