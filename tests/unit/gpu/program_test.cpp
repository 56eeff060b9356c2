#include "gpu/program.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/pass.h"
#include "gpu/timer.h"
#include "gpu_test.h"

namespace lychnite::gpu {
namespace {

using ProgramTest = GpuTest;
using Floats = std::vector<float>;

Texture pixel() {
  return Texture({.label = "pixel", .format = Format::kRgba32f, .width = 1, .height = 1});
}

TEST_F(ProgramTest, EveryTypeOfUniformArrives) {
  const Texture scalars = pixel(), vectors = pixel(), matrices = pixel(), arrays = pixel();
  Framebuffer framebuffer({.label = "u", .colours = {scalars, vectors, matrices, arrays}});
  Program program(fullScreen("pass/uniforms.frag"));
  program.set("i", -3);
  program.set("u", 4000000000u);
  program.set("f", 0.1f);
  program.set("b", true);
  program.set("i2", glm::ivec2(1, -2));
  program.set("v2", glm::vec2(1, 2));
  program.set("v3", glm::vec3(1, 2, 3));
  program.set("v4", glm::vec4(1, 2, 3, 4));
  glm::mat3 m3(0);
  m3[2][0] = 5;
  m3[0][2] = 6;
  program.set("m3", m3);
  glm::mat4 m4(0);
  m4[3][0] = 7;
  m4[0][3] = 8;
  program.set("m4", m4);
  program.set("fs", Floats{0, 9});
  program.set("v2s", std::vector<glm::vec2>{{}, {0, 10}});
  program.set("v3s", std::vector<glm::vec3>{{}, {0, 0, 11}});
  program.set("v4s", std::vector<glm::vec4>{{}, {0, 0, 0, 12}});
  Pass("uniforms", framebuffer).drawFullScreen(program);
  EXPECT_EQ(scalars.download(), (Floats{-3, 4e9f, 0.1f, 1}));
  EXPECT_EQ(vectors.download(), (Floats{-2, 2, 3, 4}));
  EXPECT_EQ(matrices.download(), (Floats{5, 6, 7, 8}));
  EXPECT_EQ(arrays.download(), (Floats{9, 10, 11, 12}));
  program.set("f", 0.25);
  Pass("double", framebuffer).drawFullScreen(program);
  EXPECT_EQ(scalars.download()[2], 0.25f);
}

TEST_F(ProgramTest, UnknownNamesAreIgnored) {
  const Texture source = pixel();
  Program program(fullScreen("pass/add.frag", {{"SCALE", "1.0"}}));
  EXPECT_TRUE(program.has("amount"));
  EXPECT_FALSE(program.has("nothing"));
  program.set("nothing", 1.0f);
  program.set("nothing", std::vector<glm::vec4>(3));
  program.setTexture("nothing", source);
  EXPECT_NO_THROW(context_->checkErrors("unknown"));
}

TEST_F(ProgramTest, DefinesMakeVariants) {
  const Texture result = pixel();
  Framebuffer framebuffer({.label = "r", .colours = {result}});
  for (const auto& [scale, expected] : {std::pair("1.0", 2.0f), std::pair("(1.0 + 2.0)", 6.0f)}) {
    Program program(fullScreen("pass/add.frag", {{"SCALE", scale}}));
    program.set("amount", glm::vec4(1));
    Pass("variant", framebuffer).drawFullScreen(program);
    EXPECT_EQ(result.download()[0], expected);
  }
}

TEST_F(ProgramTest, BlocksReadBuffers) {
  const Texture result = pixel();
  Framebuffer framebuffer({.label = "r", .colours = {result}});
  Program program(fullScreen("pass/block.frag"));
  Buffer numbers("numbers");
  numbers.upload(std::vector<glm::vec4>{{1, 2, 3, 4}, {10, 20, 30, 40}});
  EXPECT_TRUE(program.has("Numbers"));
  program.setBlock("Numbers", numbers);
  Pass("block", framebuffer).drawFullScreen(program);
  EXPECT_EQ(result.download(), (Floats{11, 22, 33, 44}));
  const Floats changed{100};
  numbers.update(4, std::as_bytes(std::span(changed)));
  Pass("block", framebuffer).drawFullScreen(program);
  EXPECT_EQ(result.download(), (Floats{11, 120, 33, 44}));
  ASSERT_EQ(numbers.download().size(), 32u);
}

TEST_F(ProgramTest, ACompileErrorNamesTheIncludedFileAndLine) {
  const Error::Parts parts = errorOf([] { Program program(fullScreen("pass/broken_include.frag")); });
  EXPECT_EQ(parts.where, "lib/broken.glsl:3");
  EXPECT_NE(parts.found.find("undefinedName"), std::string::npos) << parts.found;
  EXPECT_NE(parts.expected.find("pass/broken_include.frag"), std::string::npos) << parts.expected;
}

TEST_F(ProgramTest, ACompileErrorAfterAnIncludeNamesTheIncludingFile) {
  const Error::Parts parts = errorOf([] { Program program(fullScreen("pass/broken_after_include.frag")); });
  EXPECT_EQ(parts.where, "pass/broken_after_include.frag:4");
  EXPECT_NE(parts.found.find("thrice"), std::string::npos) << parts.found;
}

TEST_F(ProgramTest, ALinkErrorNamesBothFiles) {
  const Error::Parts parts = errorOf([] { Program program(fullScreen("pass/not_linked.frag")); });
  EXPECT_EQ(parts.where, "pass/full_screen.vert + pass/not_linked.frag");
  EXPECT_NE(parts.found.find("neverWritten"), std::string::npos) << parts.found;
}

ProgramDesc computing(const std::string& file, const std::filesystem::path& root) {
  ProgramDesc desc;
  desc.label = file;
  desc.compute = file;
  desc.root = root;
  return desc;
}

std::vector<uint32_t> numbers(const Buffer& buffer) {
  const std::vector<std::byte> bytes = buffer.download();
  std::vector<uint32_t> result(bytes.size() / sizeof(uint32_t));
  std::memcpy(result.data(), bytes.data(), bytes.size());
  return result;
}

TEST_F(ProgramTest, WhatAPassListsAComputeProgramReadsAndWrites) {
  const Texture drawn({.label = "d", .format = Format::kRgba32f, .width = 6, .height = 3});
  Texture result({.label = "r", .format = Format::kRgba32f, .width = 6, .height = 1});
  result.upload(Floats(24, -1.0f));
  Framebuffer framebuffer({.label = "d", .colours = {drawn}});
  Buffer list("list");
  list.upload(std::vector<uint32_t>(8));
  Program append(fullScreen("pass/append.frag"));
  append.setStorage("List", list);
  Pass("append", framebuffer, {.scissor = Rect{1, 0, 4, 3}}).drawFullScreen(append);
  std::vector<uint32_t> listed = numbers(list);
  ASSERT_EQ(listed[0], 4u);
  std::sort(listed.begin() + 1, listed.begin() + 5);
  EXPECT_EQ(std::vector(listed.begin() + 1, listed.begin() + 5), (std::vector<uint32_t>{1, 2, 3, 4}));

  Program scatter(computing("compute/scatter.comp", shaderRoot()));
  scatter.setStorage("List", list);
  scatter.setImage("target", result);
  Buffer groups("groups");
  groups.upload(std::vector<uint32_t>{3, 1, 1});
  dispatch("scatter", scatter, groups);
  const std::vector<float> texels = result.download();
  const std::vector<uint32_t> doubled = numbers(list);
  double sum = 0;
  for (int column = 0; column < 6; ++column) {
    const float number = texels[size_t(column) * 4];
    if (column == 0 || column == 5) {
      EXPECT_EQ(number, -1.0f) << "nobody listed column " << column;
      continue;
    }
    sum += number;
    EXPECT_EQ(doubled[size_t(number)], 2u * uint32_t(column)) << "column " << column;
  }
  EXPECT_EQ(sum, 1 + 2 + 3 + 4);
}

TEST_F(ProgramTest, AMistakeInAComputeShaderNamesItsLine) {
  const Error::Parts parts = errorOf([] { Program program(computing("compute/broken.comp", shaderRoot())); });
  EXPECT_EQ(parts.where, "compute/broken.comp:2");
  EXPECT_NE(parts.found.find("undefinedName"), std::string::npos) << parts.found;
}

TEST_F(ProgramTest, TimersMeasureWork) {
  const Texture result({.label = "r", .format = Format::kRgba32f, .width = 256, .height = 256});
  Framebuffer framebuffer({.label = "r", .colours = {result}});
  Program program(fullScreen("pass/add.frag", {{"SCALE", "1.0"}}));
  GpuTimer timer("draw");
  EXPECT_FALSE(timer.poll().has_value());
  EXPECT_EQ(timer.wait(), 0);
  for (int i = 0; i < 6; ++i) {  // more than the ring holds
    const GpuTimer::Scope scope(timer);
    Pass("timed", framebuffer, {.blend = Blend::kAdd}).drawFullScreen(program);
  }
  const double ms = timer.wait();
  EXPECT_GT(ms, 0);
  EXPECT_LT(ms, 10000);
  ASSERT_TRUE(timer.poll().has_value());
  EXPECT_EQ(*timer.poll(), ms) << "the newest stays until a newer one is done";
}

}  // namespace
}  // namespace lychnite::gpu
