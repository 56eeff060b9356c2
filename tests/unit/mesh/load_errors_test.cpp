#include <gtest/gtest.h>

#include "lychnite/base/error.h"
#include "lychnite/mesh/load.h"
#include "unit/mesh/sample_files.h"

namespace lychnite {
namespace {

std::string errorOf(const std::filesystem::path& path) {
  try {
    loadMesh(path);
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

class LoadErrors : public testing::Test {
 protected:
  void expectError(const std::string& name, std::string_view bytes, const std::string& why) {
    const auto path = folder_.write(name, bytes);
    const std::string error = errorOf(path);
    EXPECT_EQ(error.rfind(path.string(), 0), 0u) << error;
    EXPECT_NE(error.find(why), std::string::npos) << error;
  }
  sample::Folder folder_;
};

TEST_F(LoadErrors, MissingFolderEmptyAndUnknown) {
  EXPECT_NE(errorOf(folder_.path() / "none.ply").find("no such file"), std::string::npos);
  EXPECT_NE(errorOf(folder_.path()).find("a folder"), std::string::npos);
  EXPECT_NE(errorOf("/dev/null").find("device"), std::string::npos);
  expectError("empty.ply", "", "empty");
  expectError("a.fbx", "x", "(.ply .obj .stl .off .3ds .gltf .glb), found the extension '.fbx'");
  expectError("noextension", "x", "found no extension");
}

TEST_F(LoadErrors, Truncated) {
  // (Of an OBJ without its last line nobody can know that there was one.)
  for (const auto& [name, bytes] : sample::all())
    if (!name.ends_with(".gltf") && !name.ends_with(".obj"))
      expectError(name, std::string_view(bytes).substr(0, bytes.size() - 20), "");
  const std::string ply = sample::plyBinary();
  expectError("a.ply", std::string_view(ply).substr(0, ply.size() - 40), "truncated");
  expectError("b.ply", std::string_view(sample::plyText()).substr(0, 260), "truncated");
  expectError("c.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "expected \"end_header\", found the end");
}

TEST_F(LoadErrors, HeadersThatClaimTooMuch) {
  const auto ply = [](const char* format, uint64_t vertices, uint64_t faces) {
    return sample::plyHeader(format, vertices, faces) + std::string(200, ' ');
  };
  expectError("a.ply", ply("binary_little_endian", 4294967295u, 2), "4294967295 times \"vertex\"");
  expectError("b.ply", ply("ascii", 4294967295u, 2), "4294967295 times \"vertex\"");
  expectError("c.ply", ply("binary_big_endian", 1, 1ull << 62), "4611686018427387904 times \"face\"");
  expectError("d.ply", ply("ascii", UINT64_MAX, 0), "whole number");
  expectError("a.off", "OFF\n4000000000 1 0\n0 0 0\n", "4000000000 vertices");
  std::string stl = sample::stlBinary("free text");
  stl.replace(80, 4, "\xff\xff\xff\xff");
  expectError("a.stl", stl, "4294967295 triangles");
}

TEST_F(LoadErrors, CoordinatesThatAreNoNumbers) {
  expectError("a.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "NaN");
  expectError("b.obj", "v 0 0 0\nv 1 -inf 0\nv 0 1 0\nf 1 2 3\n", "infinity");
  expectError("c.obj", "v 0 0 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3\n", "range of floats in vertex 1");
  expectError("d.obj", "v 0 0 0\nv 1 x 0\nv 0 1 0\nf 1 2 3\n", "d.obj:2: expected a number, found 'x'");
  expectError("e.obj", "v 0 0\n", "e.obj:1: expected a number, found the end of the line");
  std::string ply = sample::plyBinary();
  ply.replace(ply.find("end_header\n") + 11, 4, std::string("\0\0\xc0\x7f", 4));
  expectError("a.ply", ply, "NaN");
}

TEST_F(LoadErrors, IndicesOutOfRange) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expectError("a.obj", points + "f 1 2 4\n", "a.obj:4: expected an index within the 3 vertices");
  expectError("b.obj", points + "f 0 1 2\n", "found '0'");
  expectError("c.obj", points + "f -1 -2 -4\n", "found '-4'");
  expectError("d.obj", points + "f 1//1 2//1 3//1\n", "within the 0 normals");
  expectError("e.obj", points + "f 1 2 99999999999999999999\n", "whole number");
  std::string ply = sample::plyText();
  expectError("a.ply", ply.replace(ply.rfind("7\n"), 1, "8"), "index 8 in face 5");
  ply = sample::plyText();
  expectError("b.ply", ply.replace(ply.rfind("7\n"), 1, "-1"), "found -1 in face 5");
  std::string off = sample::off();
  expectError("a.off", off.replace(off.rfind("7 255"), 1, "8"), "vertex count of 8, found '8'");
  std::string tds = sample::tds();
  expectError("a.3ds", tds.replace(tds.size() - 8, 1, "\x08"), "index 8 in face 11");
}

TEST_F(LoadErrors, NothingToRender) {
  expectError("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\np 1\n", "no face");
  expectError("b.obj", "# nothing\n", "expected an OBJ file with vertices");
  expectError("a.ply", sample::plyHeader("ascii", 0, 0), "no face");
  expectError("c.obj", "v 1 1 1\nf 1 1 1\n", "extent");
  expectError("d.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n", "degenerate");
  expectError("e.obj", "v 0 0 0\nv 1 1 1\nf 1 2\n", "face of three corners");
  expectError("a.3ds", sample::chunk(0x4D4D, sample::chunk(0x3D3D, "")), "no face");
}

TEST_F(LoadErrors, ContentThatDoesNotFitTheExtension) {
  expectError("a.obj", sample::plyText(),
              "expected OBJ, as the extension says, found content that begins like PLY");
  expectError("a.ply", sample::stlText(), "begins like STL");
  expectError("a.stl", sample::off(), "begins like OFF");
  expectError("a.off", sample::tds(), "begins like 3DS");
  expectError("a.3ds", sample::glb(), "begins like glTF");
  expectError("a.glb", "\x89PNG\r\n\x1a\n", "a picture");
  expectError("b.obj", std::string("v 0 0 0\n\0\0\0", 11), "binary data");
}

TEST_F(LoadErrors, MalformedHeaders) {
  expectError("a.ply", "ply\nelement vertex 1\nproperty float x\nend_header\n", "format");
  expectError("b.ply", "ply\nformat ascii 1.0\nproperty float x\nend_header\n",
              "b.ply:3: expected an element");
  expectError("c.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\nend_header\n",
              "a PLY type");
  expectError("d.ply", "ply\nformat ascii 1.0\nelement vertex 9\nend_header\n", "properties for the element");
  expectError("e.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
              "x, y and z");
  expectError(
      "f.ply",
      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int corners\nend_header\n3 0 0 0\n",
      "vertex_indices");
  expectError("a.off", "4OFF\n1 1 1\n", "found '4OFF'");
  expectError("b.off", "OFF BINARY\n", "text OFF");
  expectError("a.gltf", "{\"asset\":", "parse error");
  expectError("b.gltf", "{\"asset\":" + std::string(100000, '['), "nested");
  expectError("c.gltf", "[]", "no object");
  expectError("a.glb", std::string("glTF\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 20), "version 1");
}

}  // namespace
}  // namespace lychnite
