// shaders/lib in four ways: as C++ in float and in double, as the driver runs it, and the twins it must agree
// with.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <regex>
#include <set>

#include "gpu/framebuffer.h"
#include "gpu/pass.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "lychnite/base/error.h"
#include "lychnite/gpu/context.h"
#include "parity/technique/twins.h"
#include "scratch.h"

namespace lychnite {
namespace {

namespace fs = std::filesystem;

const fs::path kShaders = fs::path(LYCHNITE_SOURCE_DIR) / "shaders";

double errorOf(const glm::dvec4& value, const glm::dvec4& exact, double floor) {
  double size = floor, error = 0;
  for (int i = 0; i < 4; ++i) size = std::max(size, std::abs(exact[i]));
  for (int i = 0; i < 4; ++i) {
    if (!std::isfinite(value[i])) return INFINITY;
    error = std::max(error, std::abs(value[i] - exact[i]) / size);
  }
  return error;
}

CaseInputs<float> narrowed(const CaseInputs<double>& in) {
  CaseInputs<float> result;
  for (size_t i = 0; i < in.size(); ++i) result[i] = glm::vec4(in[i]);
  return result;
}

std::string shown(const CaseInputs<double>& in) {
  std::string text;
  for (const glm::dvec4& v : in)
    for (int i = 0; i < 4; ++i) text += " " + std::to_string(v[i]);
  return text;
}

/// The largest error over the grid, and where.
struct Largest {
  double error = 0;
  std::string where;
  void take(double e, const CaseInputs<double>& in) {
    if (e <= error) return;
    error = e;
    where = shown(in);
  }
};

class LibFunction : public testing::TestWithParam<Twin> {};

TEST_P(LibFunction, FormulaIsTheTwins) {
  const Twin& twin = GetParam();
  Largest largest;
  for (const auto& in : twin.grid)
    largest.take(errorOf(libDouble().at(twin.function)(in), twin.value(in), twin.floor), in);
  RecordProperty("error", std::to_string(largest.error));
  EXPECT_LE(largest.error, twin.formula) << "at" << largest.where;
}

TEST_P(LibFunction, RoundingStaysWithinItsBound) {
  const Twin& twin = GetParam();
  Largest largest;
  for (const auto& in : twin.grid)
    largest.take(errorOf(glm::dvec4(libFloat().at(twin.function)(narrowed(in))), twin.value(in), twin.floor),
                 in);
  EXPECT_LE(largest.error, twin.rounding) << "at" << largest.where;
}

/// A shader folder of its own: the project's lib, and one pass that evaluates an expression at every point of
/// a grid.
class ShaderFolder {
 public:
  explicit ShaderFolder(const std::string& expression) {
    fs::create_directories(folder_ / "pass");
    fs::create_directory_symlink(kShaders / "lib", folder_ / "lib");
    fs::copy_file(kShaders / "pass/full_screen.vert", folder_ / "pass/full_screen.vert");
    fs::copy_file(fs::path(LYCHNITE_SOURCE_DIR) / "tests/parity/technique/lib_all.inc",
                  folder_ / "pass/lib_all.glsl");
    std::ofstream(folder_ / "pass/case.frag")
        << "#include \"pass/lib_all.glsl\"\n"
           "uniform sampler2D inputs;\n"
           "layout(location = 0) out vec4 result;\n"
           "#define LIB_VIEW LightView(vec3(a), vec3(b), vec3(c), vec3(d), a.w, b.w)\n"
           "void main() {\n"
           "  ivec2 at = ivec2(gl_FragCoord.xy);\n"
           "  vec4 a = texelFetch(inputs, ivec2(at.x, at.y * 5), 0);\n"
           "  vec4 b = texelFetch(inputs, ivec2(at.x, at.y * 5 + 1), 0);\n"
           "  vec4 c = texelFetch(inputs, ivec2(at.x, at.y * 5 + 2), 0);\n"
           "  vec4 d = texelFetch(inputs, ivec2(at.x, at.y * 5 + 3), 0);\n"
           "  vec4 e = texelFetch(inputs, ivec2(at.x, at.y * 5 + 4), 0);\n"
           "  result = "
        << expression << ";\n}\n";
  }
  const fs::path& path() const { return folder_.path(); }

 private:
  ScratchFolder folder_;
};

/// The expression's value at every point, as the driver finds it.
std::vector<glm::vec4> runOnDriver(const std::string& expression,
                                   const std::vector<CaseInputs<double>>& grid) {
  constexpr int kWidth = 256;
  const int rows = int((grid.size() + kWidth - 1) / kWidth);
  std::vector<float> texels(size_t(kWidth) * size_t(rows) * 5 * 4);
  for (size_t i = 0; i < grid.size(); ++i)
    for (size_t k = 0; k < 5; ++k)
      for (int c = 0; c < 4; ++c)
        texels[((i / kWidth * 5 + k) * kWidth + i % kWidth) * 4 + size_t(c)] = float(grid[i][k][c]);
  gpu::Texture inputs({.label = "inputs", .width = kWidth, .height = rows * 5});
  inputs.upload(std::span<const float>(texels));
  const gpu::Texture results({.label = "results", .width = kWidth, .height = rows});
  gpu::Framebuffer framebuffer({.label = "results", .colours = {results}});
  const ShaderFolder folder(expression);
  gpu::Program program({.label = expression,
                        .vertex = "pass/full_screen.vert",
                        .fragment = "pass/case.frag",
                        .root = folder.path()});
  program.setTexture("inputs", inputs);
  gpu::Pass("case", framebuffer).drawFullScreen(program);
  const std::vector<float> values = results.download();
  std::vector<glm::vec4> result(grid.size());
  for (size_t i = 0; i < grid.size(); ++i)
    for (int c = 0; c < 4; ++c) result[i][c] = values[i * 4 + size_t(c)];
  return result;
}

TEST_P(LibFunction, DriverRunsItAsTheCompilerDoes) {
  const Twin& twin = GetParam();
  std::optional<gpu::Context> context;
  try {
    context.emplace(gpu::ContextOptions{.device = "auto", .debug = true});
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
  const std::vector<glm::vec4> values = runOnDriver(libExpressions().at(twin.function), twin.grid);
  Largest largest;
  for (size_t i = 0; i < values.size(); ++i) {
    const glm::dvec4 compiled(libFloat().at(twin.function)(narrowed(twin.grid[i])));
    largest.take(errorOf(glm::dvec4(values[i]), compiled, twin.floor), twin.grid[i]);
  }
  EXPECT_LE(largest.error, twin.driver) << "at" << largest.where;
  EXPECT_NO_THROW(context->checkErrors("parity"));
}

INSTANTIATE_TEST_SUITE_P(Lib, LibFunction, testing::ValuesIn(twins()),
                         [](const auto& twin) { return twin.param.function; });

TEST(Lib, EveryFunctionHasACaseAndATwin) {
  std::set<std::string> compared;
  for (const Twin& twin : twins()) {
    EXPECT_FALSE(twin.grid.empty()) << twin.function;
    compared.insert(twin.function);
  }
  const std::regex definition(R"(^(?:float|int|bool|vec[234]|mat[234]|[A-Z]\w*) (\w+)\()");
  size_t found = 0;
  for (const auto& entry : fs::directory_iterator(kShaders / "lib")) {
    std::istringstream text(textOf(entry.path()));
    size_t here = 0;
    for (std::string line; std::getline(text, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, definition)) continue;
      EXPECT_TRUE(compared.contains(match[1]))
          << entry.path().filename() << ": " << match[1] << " has no twin";
      ++here;
    }
    EXPECT_GT(here, 0u) << entry.path().filename() << " defines nothing that this test can see";
    found += here;
  }
  EXPECT_EQ(found, compared.size()) << "a twin of something that is gone";
}

TEST(Lib, IsPure) {
  // Neither uniforms nor samplers, built-in variables or includes, nor the swizzles that C++ lacks.
  const std::regex impure(R"(\b(uniform|sampler2D|gl_\w+|texture\w*|texelFetch|out|inout|#include)\b)");
  const std::regex swizzle(R"(\.[xyzwrgba]{2,4}\b)");
  for (const auto& entry : fs::directory_iterator(kShaders / "lib")) {
    std::istringstream text(textOf(entry.path()));
    for (std::string line; std::getline(text, line);) {
      const std::string code = line.substr(0, line.find("//"));
      EXPECT_FALSE(std::regex_search(code, impure)) << entry.path().filename() << ": " << line;
      EXPECT_FALSE(std::regex_search(code, swizzle)) << entry.path().filename() << ": " << line;
    }
  }
}

}  // namespace
}  // namespace lychnite
