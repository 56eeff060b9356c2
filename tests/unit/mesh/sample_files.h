#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "lychnite/mesh/mesh.h"

/// One small box as a file of every format, written here byte by byte so that the readers are not judged by a
/// writer of their own.
namespace sample {

/// A box of 1 x 2 x 3 at the origin, outside out: area 22, volume 6.
inline const std::array<glm::vec3, 8> kCorners = {
    {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 3}, {1, 0, 3}, {1, 2, 3}, {0, 2, 3}}};
inline const std::array<std::array<uint32_t, 4>, 6> kQuads = {
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

inline std::vector<glm::uvec3> triangles() {
  std::vector<glm::uvec3> list;
  for (const auto& q : kQuads) {
    list.push_back({q[0], q[1], q[2]});
    list.push_back({q[0], q[2], q[3]});
  }
  return list;
}

inline lychnite::Mesh box() {
  return {{kCorners.begin(), kCorners.end()}, {}, triangles()};
}

template <typename T>
void put(std::string& bytes, T value, bool big = false) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof(T));
  if (big) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}
inline void put(std::string& bytes, const glm::vec3& v, bool big = false) {
  for (int i = 0; i < 3; ++i) put(bytes, v[i], big);
}
inline std::string text(const glm::vec3& v) {
  return std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z);
}

inline std::string plyHeader(const std::string& format, uint64_t vertices, uint64_t faces) {
  return "ply\nformat " + format + " 1.0\ncomment a box\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(faces) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}
inline std::string plyText() {
  std::string file = plyHeader("ascii", 8, 6);
  for (const auto& p : kCorners) file += text(p) + "\n";
  for (const auto& q : kQuads) {
    file += "4";
    for (const uint32_t corner : q) file += " " + std::to_string(corner);
    file += "\n";
  }
  return file;
}
inline std::string plyBinary(bool big = false) {
  std::string file = plyHeader(big ? "binary_big_endian" : "binary_little_endian", 8, 6);
  for (const auto& p : kCorners) put(file, p, big);
  for (const auto& q : kQuads) {
    file += '\4';
    for (const uint32_t corner : q) put(file, corner, big);
  }
  return file;
}

inline std::string obj() {
  std::string file = "# a box\no box\n";
  for (const auto& p : kCorners) file += "v " + text(p) + "\n";
  for (const auto& q : kQuads) {
    file += "f";
    for (const uint32_t corner : q) file += " " + std::to_string(corner + 1);
    file += "\n";
  }
  return file;
}

inline std::string off() {
  std::string file = "OFF\n# a box\n8 6 12\n";
  for (const auto& p : kCorners) file += text(p) + "\n";
  for (const auto& q : kQuads) {
    file += "4";
    for (const uint32_t corner : q) file += " " + std::to_string(corner);
    file += " 255 0 0\n";
  }
  return file;
}

inline std::string stlText() {
  std::string file = "solid box\n";
  for (const auto& t : triangles()) {
    file += " facet normal 0 0 0\n  outer loop\n";
    for (int i = 0; i < 3; ++i) file += "   vertex " + text(kCorners[t[i]]) + "\n";
    file += "  endloop\n endfacet\n";
  }
  return file + "endsolid box\n";
}
inline std::string stlBinary(const std::string& title = "solid by name only") {
  std::string file = title;
  file.resize(80, ' ');
  put(file, uint32_t{12});
  for (const auto& t : triangles()) {
    put(file, glm::vec3(0));
    for (int i = 0; i < 3; ++i) put(file, kCorners[t[i]]);
    put(file, uint16_t{0});
  }
  return file;
}

inline std::string chunk(uint16_t id, const std::string& body) {
  std::string file;
  put(file, id);
  put(file, static_cast<uint32_t>(body.size() + 6));
  return file + body;
}
inline std::string tds() {
  std::string vertices, faces;
  put(vertices, uint16_t{8});
  for (const auto& p : kCorners) put(vertices, p);
  put(faces, uint16_t{12});
  for (const auto& t : triangles()) {
    for (int i = 0; i < 3; ++i) put(faces, static_cast<uint16_t>(t[i]));
    put(faces, uint16_t{7});
  }
  const std::string mesh = chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces));
  const std::string object = chunk(0x4000, std::string("box\0", 4) + mesh);
  return chunk(0x4D4D, chunk(0x0002, std::string("\3\0\0\0", 4)) + chunk(0x3D3D, object));
}

/// 8 float positions at 0 (96 bytes), 36 uint16 indices at 96 (72 bytes).
inline std::string gltfBuffer() {
  std::string bytes;
  for (const auto& p : kCorners) put(bytes, p);
  for (const auto& t : triangles())
    for (int i = 0; i < 3; ++i) put(bytes, static_cast<uint16_t>(t[i]));
  return bytes;
}
inline std::string gltfJson(const std::string& uri_member = "", const std::string& nodes = R"([{"mesh":0}])",
                            const std::string& scene_nodes = "[0]", const std::string& more = "") {
  return R"({"asset":{"version":"2.0"},)" + more + R"("scene":0,"scenes":[{"nodes":)" + scene_nodes +
         R"(}],"nodes":)" + nodes +
         R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":72}],)"
         R"("buffers":[{)" +
         uri_member + R"("byteLength":168}]})";
}
inline std::string glb(std::string json, std::string binary) {
  while (json.size() % 4) json += ' ';
  while (binary.size() % 4) binary += '\0';
  std::string file = "glTF";
  put(file, uint32_t{2});
  put(file, static_cast<uint32_t>(12 + 8 + json.size() + 8 + binary.size()));
  put(file, static_cast<uint32_t>(json.size()));
  file += "JSON" + json;
  put(file, static_cast<uint32_t>(binary.size()));
  return file + std::string("BIN\0", 4) + binary;
}
inline std::string glb() {
  return glb(gltfJson(), gltfBuffer());
}

struct Named {
  std::string file_name, bytes;
};
/// Every format; box.gltf needs box.bin (gltfBuffer()) beside it.
inline std::vector<Named> all() {
  return {{"text.ply", plyText()},      {"little.ply", plyBinary()},
          {"big.ply", plyBinary(true)}, {"box.obj", obj()},
          {"text.stl", stlText()},      {"binary.stl", stlBinary()},
          {"box.off", off()},           {"box.3ds", tds()},
          {"box.glb", glb()},           {"box.gltf", gltfJson(R"("uri":"box.bin",)")}};
}

/// A folder of this test's own, gone afterwards.
class Folder {
 public:
  Folder() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(LYCHNITE_TEST_OUTPUT_DIR) /
            (std::string("mesh-") + info->test_suite_name() + "-" + info->name() + "-" +
             std::to_string(getpid()));
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path path() const { return path_; }
  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    // A new file each time: overwriting one makes some file systems write it to the disk at once.
    std::filesystem::remove(path_ / name);
    std::ofstream(path_ / name, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace sample
