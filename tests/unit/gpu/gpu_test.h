#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "gpu/program.h"
#include "lychnite/base/error.h"
#include "lychnite/gpu/context.h"

namespace lychnite::gpu {

/// Tests that need OpenGL: a debug context for each; skipped where there is none. Every test ends
/// with checkErrors(), so an OpenGL error fails it.
class GpuTest : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = std::make_unique<Context>(ContextOptions{.device = "auto", .debug = true});
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
  void TearDown() override {
    if (!context_) return;
    EXPECT_NO_THROW(context_->checkErrors("end of test"));
  }

  static std::filesystem::path shaderRoot() {
    return std::string(LYCHNITE_SOURCE_DIR) + "/tests/unit/gpu/shaders";
  }
  static ProgramDesc fullScreen(const std::string& fragment, const ShaderDefines& defines = {}) {
    return {.label = fragment,
            .vertex = "pass/full_screen.vert",
            .fragment = fragment,
            .defines = defines,
            .root = shaderRoot()};
  }
  /// The Error that `call` throws; a failure when it throws none.
  template <class Call>
  static Error::Parts errorOf(const Call& call) {
    try {
      call();
    } catch (const Error& error) {
      return error.parts();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
  }

  std::unique_ptr<Context> context_;
};

}  // namespace lychnite::gpu
