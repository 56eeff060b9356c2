#include "gpu/pass.h"

#include <optional>
#include <vector>

#include "gpu_test.h"

namespace lychnite::gpu {
namespace {

using PassTest = GpuTest;
using Floats = std::vector<float>;

Texture target(Format format = Format::kRgba32f, int width = 4, int height = 4) {
  return Texture({.label = "target", .format = format, .width = width, .height = height});
}

Floats texel(const Texture& texture, int x, int y) {
  const Floats all = texture.download();
  const int n = channels(texture.format());
  const auto first = all.begin() + static_cast<ptrdiff_t>(n) * (y * texture.width() + x);
  return {first, first + n};
}

/// A counter-clockwise triangle over the whole target at a depth in normalised device coordinates.
void fill(VertexArray& mesh, float z) {
  mesh.setPositions(std::vector<glm::vec3>{{-1, -1, z}, {3, -1, z}, {-1, 3, z}});
  mesh.setNormals(std::vector<glm::vec3>(3, glm::vec3(0.25f, -0.5f, 0.75f)));
  mesh.setTriangles(std::vector<glm::uvec3>{{0, 1, 2}});
}

TEST_F(PassTest, AdditiveBlendingSumsFloatsExactly) {
  const Texture sum = target();
  Framebuffer framebuffer({.label = "sum", .colours = {sum}});
  framebuffer.clearColour(0, {1, 0, 0, 0});
  Program program(fullScreen("pass/add.frag", {{"SCALE", "0.5"}}));
  for (int i = 0; i < 3; ++i) {
    program.set("amount", glm::vec4(0.125f, 1e-6f, -2, 1000));
    Pass("add", framebuffer, {.blend = Blend::kAdd}).drawFullScreen(program);
  }
  EXPECT_EQ(texel(sum, 3, 2), (Floats{1.375f, 1e-6f + 1e-6f + 1e-6f, -6, 3000}));
}

TEST_F(PassTest, MinAndMaxBlendingKeepTheExtreme) {
  const Texture kept = target(Format::kR32f);
  Framebuffer framebuffer({.label = "kept", .colours = {kept}});
  Program program(fullScreen("pass/add.frag", {{"SCALE", "0.5"}}));
  const auto drawTwice = [&](Blend blend) {
    framebuffer.clearColour(0, {3, 0, 0, 0});
    for (const float value : {5.0f, 2.0f}) {
      program.set("amount", glm::vec4(value));
      Pass("extreme", framebuffer, {.blend = blend}).drawFullScreen(program);
    }
    return texel(kept, 0, 0)[0];
  };
  EXPECT_EQ(drawTwice(Blend::kMin), 2);
  EXPECT_EQ(drawTwice(Blend::kMax), 5);
  EXPECT_EQ(drawTwice(Blend::kNone), 2);
}

TEST_F(PassTest, ScissorViewportAndMaskLimitTheDraw) {
  const Texture colour = target();
  Framebuffer framebuffer({.label = "colour", .colours = {colour}});
  framebuffer.clearColour(0, {9, 9, 9, 9});
  Program program(fullScreen("pass/add.frag", {{"SCALE", "0.5"}}));
  program.set("amount", glm::vec4(1));
  Pass("mask", framebuffer,
       {.colourMask = {true, false, true, false}, .viewport = Rect{0, 0, 2, 4}, .scissor = Rect{1, 1, 3, 1}})
      .drawFullScreen(program);
  EXPECT_EQ(texel(colour, 1, 1), (Floats{1, 9, 1, 9}));
  EXPECT_EQ(texel(colour, 0, 1), (Floats{9, 9, 9, 9})) << "left of the scissor";
  EXPECT_EQ(texel(colour, 2, 1), (Floats{9, 9, 9, 9})) << "right of the viewport";
  EXPECT_EQ(texel(colour, 1, 2), (Floats{9, 9, 9, 9})) << "above the scissor";
  framebuffer.clearColour(0, {5, 6, 7, 8});
  EXPECT_EQ(texel(colour, 0, 3), (Floats{5, 6, 7, 8})) << "a clear sees nothing of the pass before";
}

TEST_F(PassTest, MeshesGiveNormalsAndTheNearestWins) {
  const Texture colour = target(), depth = target(Format::kDepth32f);
  Framebuffer framebuffer({.label = "geometry", .colours = {colour}, .depth = depth});
  framebuffer.clearColour(0, {0, 0, 0, 0});
  framebuffer.clearDepth();
  Program program(
      {.label = "mesh", .vertex = "pass/mesh.vert", .fragment = "pass/normal.frag", .root = shaderRoot()});
  VertexArray mesh("triangle");
  EXPECT_EQ(mesh.triangles(), 0u);
  fill(mesh, 0.0f);
  {
    Pass pass("geometry", framebuffer,
              {.depthTest = DepthTest::kLess, .depthWrite = true, .cull = Cull::kBack});
    for (const float z : {0.0f, 0.5f, -0.5f, 0.25f}) {
      program.set("offset", glm::vec3(0, 0, z));
      pass.drawMesh(program, mesh);
    }
    pass.drawMesh(program, VertexArray("empty"));
  }
  EXPECT_EQ(texel(colour, 2, 3), (Floats{0.25f, -0.5f, 0.75f, 0.25f}));
  EXPECT_EQ(texel(depth, 2, 3), Floats{0.25f});
  EXPECT_EQ(mesh.bytes(), 2 * 36u + 12u);
}

TEST_F(PassTest, CullingFollowsTheWinding) {
  const Texture colour = target(Format::kR32f, 1, 1);
  Framebuffer framebuffer({.label = "cull", .colours = {colour}});
  Program program(
      {.label = "mesh", .vertex = "pass/mesh.vert", .fragment = "pass/normal.frag", .root = shaderRoot()});
  VertexArray mesh("triangle");
  fill(mesh, 0.0f);
  const auto draws = [&](Cull cull) {
    framebuffer.clearColour(0, {0, 0, 0, 0});
    Pass("cull", framebuffer, {.cull = cull}).drawMesh(program, mesh);
    return texel(colour, 0, 0)[0] != 0;
  };
  EXPECT_TRUE(draws(Cull::kBack));
  EXPECT_FALSE(draws(Cull::kFront));
  mesh.setTriangles(std::vector<glm::uvec3>{{0, 2, 1}});
  EXPECT_FALSE(draws(Cull::kBack));
  EXPECT_TRUE(draws(Cull::kFront));
  EXPECT_TRUE(draws(Cull::kNone));
}

TEST_F(PassTest, SeveralTargetsAndLevels) {
  Texture first({.label = "first", .format = Format::kRgba32f, .width = 8, .height = 8, .levels = 2});
  const Texture second = target(Format::kRg16f);
  Texture source = target(Format::kRgba32f, 1, 1), other = target(Format::kRg32f, 1, 1);
  source.upload(Floats{1, 2, 3, 4});
  other.upload(Floats{5, 6});
  Framebuffer framebuffer({.label = "level 1", .colours = {{first, 1}, second}});
  EXPECT_EQ(framebuffer.width(), 4);
  EXPECT_EQ(framebuffer.colours(), 2);
  Program program(fullScreen("pass/sample.frag"));
  program.setTexture("first", source);
  program.setTexture("second", other);
  Pass("sample", framebuffer).drawFullScreen(program);
  const Floats one = first.download(1);
  EXPECT_EQ(Floats(one.begin(), one.begin() + 4), (Floats{1, 2, 3, 4}));
  EXPECT_EQ(texel(second, 3, 3), (Floats{5, 6}));
}

TEST_F(PassTest, FiltersWrapsAndLevelsAreUsed) {
  Texture source({.label = "source",
                  .format = Format::kR32f,
                  .width = 2,
                  .height = 1,
                  .levels = 2,
                  .filter = Filter::kLinear,
                  .wrap = Wrap::kClampToBorder,
                  .border = {-7, 0, 0, 0}});
  source.upload(Floats{10, 20});
  source.upload(Floats{100}, 1);
  const Texture result = target(Format::kR32f, 1, 1), unused = target(Format::kR32f, 1, 1);
  Framebuffer framebuffer({.label = "result", .colours = {result, unused}});
  Program program(fullScreen("pass/sample.frag"));
  program.setTexture("first", source);
  program.setTexture("second", source);
  const auto read = [&](float u, float level) {
    program.set("coordinate", glm::vec2(u, 0.5f));
    program.set("level", level);
    Pass("read", framebuffer).drawFullScreen(program);
    return texel(result, 0, 0)[0];
  };
  EXPECT_FLOAT_EQ(read(0.5f, 0), 15) << "linear";
  EXPECT_FLOAT_EQ(read(-2.0f, 0), -7) << "border";
  source.setFilter(Filter::kLinearMipLinear);
  EXPECT_NEAR(read(0.5f, 0.5f), 57.5f, 0.5f) << "between the levels";
  source.setFilter(Filter::kNearest);
  EXPECT_FLOAT_EQ(read(0.6f, 0), 20) << "nearest";
  source.setLevelRange(1, 1);
  EXPECT_FLOAT_EQ(read(0.6f, 0), 100) << "only level 1";
  source.setLevelRange(0, 1);
  source.setWrap(Wrap::kRepeat);
  EXPECT_FLOAT_EQ(read(1.25f, 0), 10) << "repeat";
  source.setWrap(Wrap::kClampToEdge);
  EXPECT_FLOAT_EQ(read(7.0f, 0), 20) << "edge";
}

TEST_F(PassTest, ResolveAveragesTheSamples) {
  const Texture multi({.label = "multi", .format = Format::kRgba32f, .width = 4, .height = 4, .samples = 4});
  const Texture colour = target(), other = target();
  Framebuffer from({.label = "multi", .colours = {multi}});
  Framebuffer to({.label = "resolved", .colours = {other, colour}});
  to.clearColour(0, {4, 4, 4, 4});
  from.clearColour(0, {0, 0, 0, 0});
  Program program(
      {.label = "mesh", .vertex = "pass/mesh.vert", .fragment = "pass/normal.frag", .root = shaderRoot()});
  VertexArray left("everything left of x = 1.5 pixels");
  left.setPositions(std::vector<glm::vec3>{{-0.25f, -9, 0}, {-0.25f, 9, 0}, {-9, 0, 0}});
  left.setNormals(std::vector<glm::vec3>(3, glm::vec3(1)));
  left.setTriangles(std::vector<glm::uvec3>{{0, 1, 2}});
  Pass("half", from).drawMesh(program, left);
  from.resolveColour(0, to, 1);
  EXPECT_FLOAT_EQ(texel(colour, 0, 0)[0], 1);
  EXPECT_FLOAT_EQ(texel(colour, 2, 0)[0], 0);
  EXPECT_GT(texel(colour, 1, 0)[0], 0.2f);
  EXPECT_LT(texel(colour, 1, 0)[0], 0.8f);
  EXPECT_FLOAT_EQ(texel(other, 1, 0)[0], 4) << "the other output is left alone";
  to.clearColour(0, {8, 8, 8, 8});
  EXPECT_FLOAT_EQ(texel(other, 1, 0)[0], 8) << "and can be drawn into afterwards";
}

TEST_F(PassTest, IntegerTargets) {
  const Texture numbers = target(Format::kR32ui, 3, 1);
  Framebuffer framebuffer({.label = "numbers", .colours = {numbers}});
  framebuffer.clearColour(0, 0xfffffff0u);
  EXPECT_EQ(numbers.downloadUint(), std::vector<uint32_t>(3, 0xfffffff0u));
  Program program(fullScreen("pass/uint.frag"));
  program.set("base", 0x80000000u);
  Pass("numbers", framebuffer).drawFullScreen(program);
  EXPECT_EQ(numbers.downloadUint(), (std::vector<uint32_t>{0x80000000u, 0x80000001u, 0x80000002u}));
}

TEST_F(PassTest, IncompleteFramebuffersSayWhy) {
  const Texture depth = target(Format::kDepth32f);
  const Error::Parts parts = errorOf([&] { Framebuffer({.label = "bad", .colours = {depth}}); });
  EXPECT_EQ(parts.where, "framebuffer 'bad'");
  EXPECT_FALSE(parts.found.empty());
  const Error::Parts empty = errorOf([] { Framebuffer({.label = "empty", .colours = {}}); });
  EXPECT_EQ(empty.found, "nothing is attached");
  const Texture one = target();
  const Texture four({.label = "four", .width = 4, .height = 4, .samples = 4});
  const Error::Parts mixed = errorOf([&] { Framebuffer({.label = "mixed", .colours = {one, four}}); });
  EXPECT_EQ(mixed.found, "the attachments differ in samples");
  // Attaching a depth texture as a colour is also an OpenGL error of its own on some drivers.
  try {
    context_->checkErrors("expected");
  } catch (const Error&) {
  }
}

TEST_F(PassTest, DepthOnlyFramebuffersDraw) {
  const Texture depth = target(Format::kDepth32f);
  Framebuffer framebuffer({.label = "depth", .colours = {}, .depth = depth});
  framebuffer.clearDepth(0.75f);
  EXPECT_EQ(texel(depth, 0, 0), Floats{0.75f});
  Program program(fullScreen("pass/add.frag", {{"SCALE", "1.0"}}));
  Pass("depth", framebuffer, {.depthTest = DepthTest::kAlways, .depthWrite = true}).drawFullScreen(program);
  EXPECT_EQ(texel(depth, 0, 0), Floats{0.5f});
}

}  // namespace
}  // namespace lychnite::gpu
