// Model files that are damaged, hostile or no models: one line, status 1, nothing written.
#include <gtest/gtest.h>

#include <algorithm>

#include "e2e/runner.h"

namespace lychnite::e2e {
namespace {

const char* const kTriangles = "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
const char* const kFaces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

/// A text PLY of four vertices, the given last one, and the faces of a tetrahedron.
std::string tetrahedron(const std::string& last, const std::string& faces = kFaces) {
  return std::string("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n") +
         "property float z\n" + kTriangles + "0 0 0\n1 0 0\n0 1 0\n" + last + "\n" + faces;
}

std::string binaryPly(const std::string& vertices, const std::string& body) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\n" + kTriangles + body;
}

struct BadModel {
  const char* name;
  std::string text;
  const char* words;  ///< must be in the line, beside the file's name
};

void PrintTo(const BadModel& model, std::ostream* out) {
  *out << model.name;
}

class BadModelTest : public testing::TestWithParam<BadModel> {};

TEST_P(BadModelTest, IsRefusedInOneLine) {
  const Scratch scratch;
  scratch.write("model.ply", GetParam().text);
  const Result result = scratch.run(renderArguments("model.ply", {"--size", "10mm", "-o", "out.png"}));
  expectOneLine(result, 1, "model.ply");
  EXPECT_NE(result.err.find(GetParam().words), std::string::npos) << result.err;
  EXPECT_LT(result.peakBytes, size_t(200) << 20) << "allocates what the header claims";
  EXPECT_EQ(scratch.names(), std::set<std::string>{"model.ply"});
}

std::vector<BadModel> badModels() {
  return {
      {"Empty", "", "an empty one"},
      {"NotAPly", "this is no mesh\n", "first line \"ply\""},
      {"HeaderOnly", binaryPly("4", ""), "truncated"},
      {"TruncatedBinary", binaryPly("4", std::string(30, '\0')), "truncated"},
      {"TruncatedText", tetrahedron("0 0 1", "3 0 2 1\n3 0 1"), "face 1"},
      {"FourBillionVertices", binaryPly("4000000000", std::string(48, '\0')), "4000000000"},
      {"NegativeVertices", binaryPly("-4", std::string(48, '\0')), "'-4'"},
      {"NanCoordinates", tetrahedron("0 0 nan"), "vertex 3"},
      {"InfiniteCoordinates", tetrahedron("0 0 inf"), "vertex 3"},
      {"FacePastTheVertices", tetrahedron("0 0 1", "3 0 2 1\n3 0 1 3\n3 1 2 4\n3 0 3 2\n"),
       "index 4 in face 2"},
      {"NegativeFaceIndex", tetrahedron("0 0 1", "3 0 2 1\n3 0 1 3\n3 1 2 -1\n3 0 3 2\n"), "-1 in face 2"},
      {"ZeroSize",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 1\nproperty list uchar int vertex_indices\nend_header\n1 1 1\n1 1 1\n1 1 1\n3 0 1 2\n",
       "extent"},
      {"NoTriangles",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n",
       "no face"}};
}

INSTANTIATE_TEST_SUITE_P(Files, BadModelTest, testing::ValuesIn(badModels()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(BadModelPath, MissingFile) {
  const Scratch scratch;
  const Result result = scratch.run(renderArguments("none.ply", {"--size", "10mm", "-o", "out.png"}));
  expectOneLine(result, 1, "none.ply");
  EXPECT_TRUE(scratch.names().empty());
}

TEST(BadModelPath, Folder) {
  const Scratch scratch;
  std::filesystem::create_directory(scratch / "folder.ply");
  const Result result = scratch.run(renderArguments("folder.ply", {"--size", "10mm", "-o", "out.png"}));
  expectOneLine(result, 1, "folder.ply");
  EXPECT_EQ(scratch.names(), std::set<std::string>{"folder.ply"});
}

TEST(BadModelPath, OtherFormatsCutShort) {
  const std::pair<const char*, std::string> files[] = {
      {"model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"},
      {"model.stl", std::string(80, '\0') + "\xff\xff\xff\xff" + std::string(10, '\0')},
      {"model.off", "OFF\n4000000000 1 0\n"},
      {"model.3ds", "MM\xff\xff\xff\xff"},
      {"model.gltf", "{"},
      {"model.glb", std::string("glTF\2\0\0\0", 8)}};
  for (const auto& [name, text] : files) {
    const Scratch scratch;
    scratch.write(name, text);
    const Result result = scratch.run(renderArguments(name, {"--size", "10mm", "-o", "out.png"}));
    expectOneLine(result, 1, name);
    EXPECT_LT(result.peakBytes, size_t(200) << 20) << name;
    EXPECT_EQ(scratch.names(), std::set<std::string>{name});
  }
}

TEST(BadModelPath, UnknownFormat) {
  const Scratch scratch;
  scratch.write("mesh.xyz", "0 0 0\n");
  const Result result = scratch.run(renderArguments("mesh.xyz", {"--size", "10mm", "-o", "out.png"}));
  expectOneLine(result, 1, "mesh.xyz");
  EXPECT_EQ(scratch.names(), std::set<std::string>{"mesh.xyz"});
}

TEST(BadModelPath, InfoRefusesThemToo) {
  const Scratch scratch;
  scratch.write("huge.ply", binaryPly("4000000000", std::string(48, '\0')));
  expectOneLine(scratch.run({"info", "huge.ply", "--json"}), 1, "4000000000");
  expectOneLine(scratch.run({"info", "none.ply"}), 1, "none.ply");
}

TEST(BadModelPath, UnknownBuiltinSuggestsTheNearest) {
  const Scratch scratch;
  const Result result = scratch.run(renderArguments("sphare", {"--size", "10mm", "-o", "out.png"}));
  expectOneLine(result, 1, "sphere");
  EXPECT_TRUE(scratch.names().empty());
}

TEST(OddModel, FlatMeshRenders) {
  const Scratch scratch;
  scratch.write(
      "flat.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  const Result result = scratch.run(renderArguments("flat.ply", {"--size", "10mm", "-o", "out.png"}));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(scratch.names(), (std::set<std::string>{"flat.ply", "out.png"}));
}

TEST(BadScene, TypoNamesFileAndLine) {
  const Scratch scratch;
  ASSERT_EQ(scratch.run(renderArguments("stone", {"--size", "10mm", "-o", "a.exr", "--save-scene", "a.toml"}))
                .status,
            0);
  std::string text = scratch.read("a.toml");
  const auto at = text.find("size");
  ASSERT_NE(at, std::string::npos);
  const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n');
  scratch.write("bad.toml", text.replace(at, 4, "sice"));
  const Result result = scratch.run(renderArguments("bad.toml", {"-o", "out.png"}));
  expectOneLine(result, 1, "bad.toml:" + std::to_string(line));
  EXPECT_NE(result.err.find("sice"), std::string::npos) << result.err;
  EXPECT_EQ(scratch.names(), (std::set<std::string>{"a.exr", "a.toml", "bad.toml"}));
}

struct BadSceneText {
  const char* name;
  std::string text;
  const char* words;
};

void PrintTo(const BadSceneText& scene, std::ostream* out) {
  *out << scene.name;
}

class BadSceneTest : public testing::TestWithParam<BadSceneText> {};

TEST_P(BadSceneTest, NamesFileAndLine) {
  const Scratch scratch;
  scratch.write("bad.toml", GetParam().text);
  const Result result = scratch.run(renderArguments("bad.toml", {"-o", "out.png"}));
  expectOneLine(result, 1, GetParam().words);
  EXPECT_EQ(scratch.names(), std::set<std::string>{"bad.toml"});
}

std::vector<BadSceneText> badScenes() {
  const std::string object = "[[object]]\nmodel = \"stone\"\nsize = \"20mm\"\n";
  return {{"Syntax", "[camera]\nazimuth = = 3\n", "bad.toml:2"},
          {"Typo", object + "materiel = \"marble\"\n", "did you mean 'material'?"},
          {"SizeWithoutUnit", "[[object]]\nmodel = \"stone\"\nsize = 20\n", "bad.toml:3"},
          {"NoObject", "background = 0.1\n", "[[object]]"},
          {"UnknownLight", object + "[[light]]\ntype = \"sun\"\n", "bad.toml:5"},
          {"MissingModel", "[[object]]\nmodel = \"none.ply\"\nsize = \"20mm\"\n", "none.ply"}};
}

INSTANTIATE_TEST_SUITE_P(Files, BadSceneTest, testing::ValuesIn(badScenes()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(BadScene, MissingFile) {
  const Scratch scratch;
  expectOneLine(scratch.run(renderArguments("none.toml", {"-o", "out.png"})), 1, "none.toml");
  EXPECT_TRUE(scratch.names().empty());
}

}  // namespace
}  // namespace lychnite::e2e
