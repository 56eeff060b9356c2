#include "lychnite/mesh/load.h"

#include <gtest/gtest.h>

#include <set>

#include "unit/mesh/sample_files.h"

namespace lychnite {
namespace {

class Load : public testing::Test {
 protected:
  LoadedMesh load(const std::string& name, std::string_view bytes) {
    return loadMesh(folder_.write(name, bytes));
  }
  sample::Folder folder_;
};

void expectBox(const LoadedMesh& loaded, const std::string& name) {
  const MeshInfo info = inspect(*loaded.mesh);
  EXPECT_EQ(info.vertices, 8u) << name;
  EXPECT_EQ(info.triangles, 12u) << name;
  EXPECT_TRUE(info.closed) << name;
  EXPECT_DOUBLE_EQ(info.area, 22.0) << name;
  EXPECT_DOUBLE_EQ(info.volume, 6.0) << name;
  EXPECT_TRUE(loaded.report.normals_made) << name;
  EXPECT_FALSE(loaded.report.flipped) << name;
}

TEST_F(Load, ReadsABoxFromEveryFormat) {
  folder_.write("box.bin", sample::gltfBuffer());
  for (const auto& [name, bytes] : sample::all()) expectBox(load(name, bytes), name);
}

TEST_F(Load, IgnoresTheCaseOfTheExtension) {
  expectBox(load("BOX.Ply", sample::plyText()), "BOX.Ply");
}

TEST_F(Load, CountsStlCornersAsVertices) {
  const LoadedMesh loaded = load("box.stl", sample::stlBinary());
  EXPECT_EQ(loaded.report.file_vertices, 36u);
  EXPECT_EQ(loaded.report.duplicate_vertices, 28u);
}

TEST_F(Load, ReadsLineEndsOfEverySystem) {
  for (const std::string end : {"\r\n", "\r"}) {
    for (const auto& [name, text] : {sample::Named{"a.ply", sample::plyText()},
                                     {"a.obj", sample::obj()},
                                     {"a.off", sample::off()},
                                     {"a.stl", sample::stlText()}}) {
      std::string converted;
      for (const char c : text) converted += c == '\n' ? end : std::string(1, c);
      expectBox(load(name, converted), name);
    }
  }
}

TEST_F(Load, PlyTakesItsPropertiesByNameAndSkipsOthers) {
  const std::string file =
      "ply\nformat ascii 1.0\nobj_info x\nelement camera 1\nproperty list uchar float matrix\nelement vertex "
      "3\n"
      "property uchar red\nproperty double z\nproperty float y\nproperty list uchar int tags\nproperty float "
      "x\n"
      "element face 1\nproperty float quality\nproperty list uint8 uint32 vertex_index\nend_header\n"
      "2 0.5 0.25\n1 3 2 0 1\n9 3 4 2 7 8 5\n9 3 2 1 6 9\n0.5 3 0 1 2\n";
  const LoadedMesh loaded = load("a.ply", file);
  EXPECT_EQ(loaded.mesh->positions, (std::vector<glm::vec3>{{1, 2, 3}, {5, 4, 3}, {9, 2, 3}}));
}

TEST_F(Load, PlyFacesMayComeBeforeTheVertices) {
  const std::string file =
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(load("a.ply", file).mesh->triangles.size(), 1u);
}

TEST_F(Load, PlyNormalsAreKept) {
  const std::string file =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n"
      "0 0 0 0 3 4\n1 0 0 0 0 2\n0 1 0 1 0 1\n3 0 1 2\n";
  const LoadedMesh loaded = load("a.ply", file);
  EXPECT_FALSE(loaded.report.normals_made);
  EXPECT_FLOAT_EQ(loaded.mesh->normals[0].y, 0.6f);
  EXPECT_FLOAT_EQ(loaded.mesh->normals[1].z, 1.0f);
}

TEST_F(Load, NumbersMayHaveSignsAndExponents) {
  const LoadedMesh loaded = load("a.obj", "v +1e0 -2.5E+1 1e-400\nv 0 0 0\nv 1 1 1\nf +1 2 3\n");
  EXPECT_EQ(loaded.mesh->positions[0], glm::vec3(1, -25, 0));
}

TEST_F(Load, ObjKnowsNegativeIndicesContinuedLinesAndSlashes) {
  const std::string file =
      "mtllib none.mtl\nv 0 0 0 1 0.5 0.5 0.5\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nl 1 2\np 1\n"
      "usemtl x\ns off\nf -3/1/1 \\\n -2/-1/-1 -1//1 # all of it\n";
  const LoadedMesh loaded = load("a.obj", file);
  EXPECT_EQ(loaded.mesh->triangles, (std::vector<glm::uvec3>{{0, 1, 2}}));
  EXPECT_EQ(loaded.mesh->positions[1], glm::vec3(1, 0, 0));
  EXPECT_FALSE(loaded.report.normals_made);
}

TEST_F(Load, ObjNormalsSplitVerticesAtCreases) {
  const std::string file =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 7 7 7\nvn 0 0 1\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1//2 3//2 4//2\n";
  const LoadedMesh loaded = load("a.obj", file);
  EXPECT_EQ(loaded.mesh->positions.size(), 6u);
  EXPECT_EQ(loaded.report.unused_vertices, 1u);
  EXPECT_FALSE(loaded.report.normals_made);
}

TEST_F(Load, ObjNormalsOfSomeFacesOnlyAreNotUsed) {
  const LoadedMesh loaded =
      load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\n");
  EXPECT_EQ(loaded.mesh->positions.size(), 4u);
  EXPECT_TRUE(loaded.report.normals_made);
}

// An arrow head of area 1 whose fan around the first corner would cover 3.
TEST_F(Load, ConcaveFacesKeepTheirShape) {
  const std::string file = "OFF 4 1 0\n0 3 5\n-1 0 5\n0 2 5\n1 0 5\n4 1 2 3 0\n";
  for (const int start : {0, 1, 2, 3}) {
    std::string turned = file.substr(0, file.size() - 10) + "4";
    for (int i = 0; i < 4; ++i) turned += " " + std::to_string((start + i) % 4);
    const MeshInfo info = inspect(*load("a.off", turned + "\n").mesh);
    EXPECT_EQ(info.triangles, 2u);
    EXPECT_DOUBLE_EQ(info.area, 1.0) << "from corner " << start;
  }
}

TEST_F(Load, FacesOfManyCornersKeepTheirArea) {
  // A comb: n teeth of area 1/2 on a bar of area n.
  const int teeth = 100;
  std::string points, face;
  for (int i = 0; i <= 2 * teeth; ++i)
    points += std::to_string(teeth - i / 2.0) + " " + std::to_string(1 + i % 2) + " 0\n";
  points += "0 0 0\n" + std::to_string(teeth) + " 0 0\n";
  const int corners = 2 * teeth + 3;
  for (int i = 0; i < corners; ++i) face += " " + std::to_string(i);
  const std::string file =
      "OFF\n" + std::to_string(corners) + " 1 0\n" + points + std::to_string(corners) + face + "\n";
  EXPECT_NEAR(inspect(*load("comb.off", file).mesh).area, 1.5 * teeth, 1e-3);
}

TEST_F(Load, OffNormalsAreKeptAndColoursSkipped) {
  const LoadedMesh loaded =
      load("a.off",
           "NOFF # with normals\n3 1 0\n0 0 0 0 0 1 9 9 9\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2 0.5 0.5 0.5\n");
  EXPECT_FALSE(loaded.report.normals_made);
  EXPECT_EQ(loaded.mesh->triangles.size(), 1u);
}

TEST_F(Load, StlSolidsBecomeOneMesh) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 %\nendloop\nendfacet\n";
  std::string one = facet, two = facet;
  one.replace(one.find('%'), 1, "1");
  two.replace(two.find('%'), 1, "2");
  EXPECT_EQ(load("a.stl", "solid a\n" + one + "endsolid a\n\nsolid b\n" + two + "endsolid\n")
                .mesh->triangles.size(),
            2u);
}

TEST_F(Load, TdsMeshesAreJoined) {
  const std::string one = sample::tds();
  // The editor chunk holds two objects now: its header is at 16, the object follows.
  const std::string object = one.substr(22);
  const std::string file = sample::chunk(0x4D4D, sample::chunk(0x3D3D, object + object));
  const LoadedMesh loaded = load("two.3ds", file);
  EXPECT_EQ(loaded.report.file_vertices, 16u);
  EXPECT_EQ(loaded.report.file_triangles, 24u);
  EXPECT_EQ(loaded.report.duplicate_vertices, 8u);
}

}  // namespace
}  // namespace lychnite
