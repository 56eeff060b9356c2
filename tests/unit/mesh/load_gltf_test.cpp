#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "lychnite/base/error.h"
#include "lychnite/mesh/load.h"
#include "unit/mesh/sample_files.h"

namespace lychnite {
namespace {

class LoadGltf : public testing::Test {
 protected:
  LoadedMesh load(const std::string& json, const std::string& buffer = sample::gltfBuffer()) {
    return loadMesh(folder_.write("a.glb", sample::glb(json, buffer)));
  }
  std::string errorOf(const std::string& json) {
    try {
      load(json);
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  }
  /// The sample's document with one piece of its text replaced.
  static std::string with(const std::string& from, const std::string& to) {
    std::string json = sample::gltfJson();
    EXPECT_NE(json.find(from), std::string::npos) << from;
    return json.replace(json.find(from), from.size(), to);
  }
  sample::Folder folder_;
};

TEST_F(LoadGltf, NodesMoveTurnAndScale) {
  // A quarter turn about z after doubling x; then the parent lifts it by 10.
  const std::string nodes =
      R"([{"translation":[0,0,10],"children":[1]},)"
      R"({"mesh":0,"rotation":[0,0,0.70710678118654752,0.70710678118654752],"scale":[2,1,1]}])";
  const MeshInfo info = inspect(*load(sample::gltfJson("", nodes)).mesh);
  EXPECT_NEAR(info.volume, 12.0, 1e-5);
  EXPECT_NEAR(glm::length(info.bounds.min - glm::dvec3(-2, 0, 10)), 0, 1e-6);
  EXPECT_NEAR(glm::length(info.bounds.max - glm::dvec3(0, 2, 13)), 0, 1e-6);
}

TEST_F(LoadGltf, AMatrixIsColumnMajorAndAMirrorKeepsTheOutside) {
  const std::string nodes = R"([{"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]}])";
  const LoadedMesh loaded = load(sample::gltfJson("", nodes));
  const MeshInfo info = inspect(*loaded.mesh);
  EXPECT_FALSE(loaded.report.flipped);
  EXPECT_NEAR(info.volume, 6.0, 1e-5);
  EXPECT_EQ(info.bounds.min, glm::dvec3(4, 6, 7));
}

TEST_F(LoadGltf, AMeshUnderTwoNodesIsThereTwice) {
  const LoadedMesh loaded =
      load(sample::gltfJson("", R"([{"mesh":0},{"mesh":0,"translation":[9,0,0]}])", "[0,1]"));
  EXPECT_EQ(inspect(*loaded.mesh).components, 2u);
}

TEST_F(LoadGltf, OnlyTheShownSceneCounts) {
  EXPECT_EQ(load(sample::gltfJson("", R"([{"mesh":0},{"mesh":0,"translation":[9,0,0]}])", "[1]"))
                .mesh->positions[0]
                .x,
            9.0f);
}

TEST_F(LoadGltf, WithoutScenesTheRootsCount) {
  EXPECT_EQ(load(with(R"("scene":0,"scenes":[{"nodes":[0]}],)", "")).mesh->triangles.size(), 12u);
}

TEST_F(LoadGltf, ReadsDataUris) {
  // Three float positions: (0,0,0), (1,0,0), (0,1,0), in base64; drawn without indices.
  const std::string json =
      R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
      R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  const LoadedMesh loaded = loadMesh(folder_.write("a.gltf", json));
  EXPECT_EQ(loaded.mesh->positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST_F(LoadGltf, UrisArePercentDecoded) {
  folder_.write("a b.bin", sample::gltfBuffer());
  const auto path = folder_.write("a.gltf", sample::gltfJson(R"("uri":"a%20b.bin",)"));
  EXPECT_EQ(loadMesh(path).mesh->triangles.size(), 12u);
}

TEST_F(LoadGltf, StripsAndFansKeepTheirFacing) {
  // A strip around 0 1 3 2 of the box's floor, and a fan: both are the one quad of area 2 that faces down.
  const std::string strip_order{'\0', 0, 3, 0, 1, 0, 2, 0}, fan_order{'\0', 0, 3, 0, 2, 0, 1, 0};
  for (const auto& [mode, order] : {std::pair(5, strip_order), std::pair(6, fan_order)}) {
    std::string buffer = sample::gltfBuffer();
    buffer.replace(96, 8, order);
    std::string json = with(R"("indices":1})", R"("indices":1,"mode":)" + std::to_string(mode) + "}");
    json.replace(json.find(R"("count":36)"), 10, R"("count":4)");
    const LoadedMesh loaded = load(json, buffer);
    ASSERT_EQ(loaded.mesh->triangles.size(), 2u) << mode;
    EXPECT_DOUBLE_EQ(inspect(*loaded.mesh).area, 2.0) << mode;
    for (const glm::vec3& n : loaded.mesh->normals) EXPECT_EQ(n, glm::vec3(0, 0, -1)) << mode;
  }
}

TEST_F(LoadGltf, QuantizedPositionsAndNormalsAreScaled) {
  std::string buffer;
  for (const uint16_t v : {0, 0, 0, 0, 65535, 0, 0, 0, 0, 65535, 0, 0}) sample::put(buffer, v);
  for (int i = 0; i < 3; ++i) buffer += std::string("\0\0\x7f\0", 4);
  const std::string json =
      R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_mesh_quantization"],"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1}}]}],"accessors":[)"
      R"({"bufferView":0,"componentType":5123,"normalized":true,"count":3,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5120,"normalized":true,"count":3,"type":"VEC3"}],"bufferViews":[)"
      R"({"buffer":0,"byteLength":24,"byteStride":8},{"buffer":0,"byteOffset":24,"byteLength":12,"byteStride":4}],)"
      R"("buffers":[{"byteLength":36}]})";
  const LoadedMesh loaded = load(json, buffer);
  EXPECT_EQ(loaded.mesh->positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(loaded.mesh->normals[2], glm::vec3(0, 0, 1));
  EXPECT_FALSE(loaded.report.normals_made);
}

TEST_F(LoadGltf, SparseValuesReplaceTheirBase) {
  std::string buffer = sample::gltfBuffer();
  sample::put(buffer, uint32_t{6});
  sample::put(buffer, glm::vec3(1, 2, 9));
  std::string json = with(R"("count":8,"type":"VEC3")",
                          R"("count":8,"type":"VEC3","sparse":{"count":1,)"
                          R"("indices":{"bufferView":2,"componentType":5125},"values":{"bufferView":3}})");
  json.replace(json.find(R"("byteLength":72})"), 16,
               R"("byteLength":72},{"buffer":0,"byteOffset":168,"byteLength":4},)"
               R"({"buffer":0,"byteOffset":172,"byteLength":12})");
  json.replace(json.find(R"("byteLength":168)"), 16, R"("byteLength":184)");
  EXPECT_EQ(load(json, buffer).mesh->positions[6], glm::vec3(1, 2, 9));
}

TEST_F(LoadGltf, RefusesExtensionsThatChangeTheGeometry) {
  const auto requiring = [](const std::string& name) {
    return sample::gltfJson("", R"([{"mesh":0}])", "[0]", R"("extensionsRequired":[")" + name + R"("],)");
  };
  EXPECT_NE(errorOf(requiring("KHR_draco_mesh_compression")).find("KHR_draco_mesh_compression"),
            std::string::npos);
  EXPECT_EQ(errorOf(requiring("KHR_materials_volume")), "no error");
}

TEST_F(LoadGltf, RefusesWhatPointsOutOfRange) {
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& why) {
    const std::string error = errorOf(with(from, to));
    EXPECT_NE(error.find(why), std::string::npos) << to << ": " << error;
  };
  refused(R"("POSITION":0)", R"("POSITION":7)", "index below the 2 accessors, found 7");
  refused(R"("POSITION":0)", R"("POSITION":-1)", "found -1");
  refused(R"("bufferView":1)", R"("bufferView":2)", "index below the 2 bufferViews");
  refused(R"("buffer":0)", R"("buffer":1)", "index below the 1 buffers");
  refused(R"("byteLength":96)", R"("byteLength":960)", "within the 168 bytes");
  refused(R"("byteOffset":96)", R"("byteOffset":18446744073709551615)", "within the 168 bytes");
  refused(R"("count":8)", R"("count":9)", "within the 96 bytes of their view");
  refused(R"("count":8)", R"("count":4611686018427387904)", "within the 96 bytes of their view");
  refused(R"("count":8)", R"("count":7)", "indices below the vertex count of 7");
  refused(R"("byteLength":168)", R"("byteLength":400000000000)", "400000000000 bytes in buffer 0");
  refused(R"([{"mesh":0}])", R"([{"mesh":1}])", "index below the 1 meshes");
  refused(R"("nodes":[0])", R"("nodes":[3])", "index below the 1 nodes");
  refused(R"("version":"2.0")", R"("version":"1.0")", "glTF 2");
  refused(R"("bufferView":0,"componentType":5126)", R"("componentType":5126)", "compression");
}

TEST_F(LoadGltf, RefusesNodesInALoop) {
  EXPECT_NE(errorOf(sample::gltfJson("", R"([{"children":[1]},{"mesh":0,"children":[0]}])")).find("loop"),
            std::string::npos);
}

TEST_F(LoadGltf, NamesAMissingBuffer) {
  const auto path = folder_.write("a.gltf", sample::gltfJson(R"("uri":"gone.bin",)"));
  try {
    loadMesh(path);
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("gone.bin: expected a file, found no such file"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace lychnite
