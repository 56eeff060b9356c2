#include "gpu/shader_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "lychnite/base/error.h"

namespace lychnite::gpu {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::filesystem::path kRoot = std::string(LYCHNITE_SOURCE_DIR) + "/tests/unit/gpu/shaders";

size_t count(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(ShaderSourceTest, IncludesOnceAndKnowsWhereLinesComeFrom) {
  const ShaderSource source = assembleShader(kRoot, "pass/add.frag", GlslDialect::kDesktop450);
  EXPECT_THAT(source.files, ElementsAre("pass/add.frag", "lib/twice.glsl"));
  EXPECT_EQ(count(source.text, "vec4 twice(vec4 v)"), 1u);
  EXPECT_THAT(source.text, HasSubstr("vec4 twice(vec4 v) { return v + v; }\nuniform vec4 amount;\n"));
  EXPECT_THAT(source.text, Not(HasSubstr("#include")));
  ASSERT_EQ(source.lines.size(), count(source.text, "\n"));
  const size_t header = count(source.text.substr(0, source.text.find("vec4 twice")), "\n");
  EXPECT_EQ(source.lines[header - 1].line, 0);
  EXPECT_EQ(source.lines[header].file, 1);
  EXPECT_EQ(source.lines[header].line, 1);
  EXPECT_EQ(source.lines[header + 1].file, 0);
  EXPECT_EQ(source.lines[header + 1].line, 3);
}

TEST(ShaderSourceTest, DesktopHeaderAndDefines) {
  const ShaderSource source =
      assembleShader(kRoot, "pass/add.frag", GlslDialect::kDesktop450, {{"SCALE", "2.0"}, {"METHOD", "1"}});
  EXPECT_THAT(source.text, StartsWith("#version 450 core\n"));
  EXPECT_THAT(source.text, HasSubstr("#define SCALE 2.0\n#define METHOD 1\nvec4 twice"));
  EXPECT_THAT(source.text, HasSubstr("#define OUT(T) out T\n#define INOUT(T) inout T\n"));
  EXPECT_THAT(source.text, Not(HasSubstr("LYCHNITE_ES")));
  EXPECT_THAT(source.text, Not(HasSubstr("precision")));
}

TEST(ShaderSourceTest, EsHeaderHasPrecisions) {
  const ShaderSource source = assembleShader(kRoot, "pass/add.frag", GlslDialect::kEs300, {{"SCALE", "2.0"}});
  EXPECT_THAT(source.text, StartsWith("#version 300 es\n"));
  for (const char* type : {"float", "int", "sampler2D", "usampler2D"})
    EXPECT_THAT(source.text, HasSubstr("precision highp " + std::string(type) + ";\n"));
  EXPECT_THAT(source.text, HasSubstr("#define LYCHNITE_ES 1\n"));
  EXPECT_THAT(source.text, HasSubstr("#define SCALE 2.0\n"));
}

TEST(ShaderSourceTest, AMissingIncludeNamesTheIncludingLine) {
  try {
    assembleShader(kRoot, "pass/missing_include.frag", GlslDialect::kDesktop450);
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.parts().where, "pass/missing_include.frag:2");
    EXPECT_THAT(error.parts().found, HasSubstr("lib/not_there.glsl"));
  }
}

TEST(ShaderSourceTest, MissingAndUnreadableFilesAreErrors) {
  EXPECT_THROW(assembleShader(kRoot, "pass/none.frag", GlslDialect::kDesktop450), Error);
  EXPECT_THROW(assembleShader(kRoot, "pass", GlslDialect::kDesktop450), Error);
}

TEST(ShaderLogTest, FindsThePlaceInEachDriversLog) {
  const ShaderSource source{.text = "#version\nfunction\nmain\n",
                            .files = {"pass/a.frag", "lib/b.glsl"},
                            .lines = {{0, 0}, {1, 12}, {0, 7}}};
  const struct {
    const char *log, *where, *text;
  } cases[] = {
      {"0:2(3): error: `x' undeclared\n0:3(1): error: more", "lib/b.glsl:12", "`x' undeclared"},
      {"0:2(1): warning: slow\n0:3(2): preprocessor error: no", "pass/a.frag:7", "no"},
      {"0(2) : error C1503: undefined variable", "lib/b.glsl:12", "C1503: undefined variable"},
      {"ERROR: 0:3: 'y' : undeclared identifier", "pass/a.frag:7", "'y' : undeclared identifier"},
      {"0:1(1): error: version", "pass/a.frag (its defines)", "version"},
      {"0:99(1): error: far away", "pass/a.frag", "far away"},
      {"\nerror: something else\n", "pass/a.frag", "error: something else"},
      {"", "pass/a.frag", "an error without a message"},
  };
  for (const auto& c : cases) {
    const ShaderMessage message = firstError(c.log, source);
    EXPECT_EQ(message.where, c.where) << c.log;
    EXPECT_EQ(message.text, c.text) << c.log;
  }
}

class ShaderDirTest : public ::testing::Test {
 protected:
  void TearDown() override { unsetenv("LYCHNITE_SHADER_DIR"); }
};

TEST_F(ShaderDirTest, TheBuildTreeFindsItsSources) {
  unsetenv("LYCHNITE_SHADER_DIR");
  EXPECT_TRUE(std::filesystem::equivalent(findShaderDir(), std::string(LYCHNITE_SOURCE_DIR) + "/shaders"));
}

TEST_F(ShaderDirTest, TheEnvironmentComesFirst) {
  setenv("LYCHNITE_SHADER_DIR", kRoot.c_str(), 1);
  EXPECT_EQ(findShaderDir(), kRoot);
}

TEST_F(ShaderDirTest, AMissingFolderNamesThePlaces) {
  setenv("LYCHNITE_SHADER_DIR", "/nonexistent/shaders", 1);
  try {
    findShaderDir();
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nonexistent/shaders"));
  }
}

}  // namespace
}  // namespace lychnite::gpu
