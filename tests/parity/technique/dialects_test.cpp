// Every pass as text of both languages.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "gpu/shader_source.h"
#include "scratch.h"

namespace lychnite {
namespace {

namespace fs = std::filesystem;
using gpu::GlslDialect;

const fs::path kShaders = fs::path(LYCHNITE_SOURCE_DIR) / "shaders";

std::vector<std::string> passes() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(kShaders / "pass"))
    if (entry.path().extension() != ".glsl") files.push_back("pass/" + entry.path().filename().string());
  return files;
}

TEST(Dialects, EveryPassAssembles) {
  ASSERT_GT(passes().size(), 8u);
  for (const std::string& file : passes()) {
    const auto es = gpu::assembleShader(kShaders, file, GlslDialect::kEs300, {{"LAYOUT", "2"}});
    EXPECT_EQ(es.text.rfind("#version 300 es\n", 0), 0u) << file;
    EXPECT_NE(es.text.find("precision highp float;"), std::string::npos) << file;
    const auto desktop = gpu::assembleShader(kShaders, file, GlslDialect::kDesktop450, {{"LAYOUT", "2"}});
    EXPECT_EQ(desktop.text.rfind("#version 450 core\n", 0), 0u) << file;
    for (const auto& source : {es, desktop}) {
      EXPECT_EQ(source.text.find("#include"), std::string::npos) << file;
      EXPECT_NE(source.text.find("void main()"), std::string::npos) << file;
    }
  }
}

TEST(Dialects, NothingThatEs300Lacks) {
  // Desktop features that a pass could use without noticing: layout qualifiers of uniforms, suffixes and
  // integer to float conversions in literals, double precision, image and buffer access, gather, implicit LOD
  // queries.
  const std::regex lacking(
      R"(\b(binding\s*=|double|dvec[234]|textureGather|textureQueryL\w+|imageLoad|imageStore|buffer\s*\{|fma|sampler1D|texture1D|[0-9]\.[0-9]*lf)\b)");
  const std::regex initialiser(R"(=\s*\{)");
  for (const std::string& file : passes()) {
    std::istringstream text(gpu::assembleShader(kShaders, file, GlslDialect::kEs300, {{"LAYOUT", "2"}}).text);
    for (std::string line; std::getline(text, line);) {
      const std::string code = line.substr(0, line.find("//"));
      EXPECT_FALSE(std::regex_search(code, lacking)) << file << ": " << line;
      EXPECT_FALSE(std::regex_search(code, initialiser)) << file << ": " << line;
    }
  }
}

}  // namespace
}  // namespace lychnite
