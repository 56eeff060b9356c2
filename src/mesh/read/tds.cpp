#include <utility>

#include "lychnite/base/error.h"
#include "mesh/read/byte_cursor.h"
#include "mesh/read/readers.h"

namespace lychnite {
namespace {

// The chunks that hold geometry (3D Studio File Format, Autodesk / J. van Velsen 1997). A mesh's vertices are
// in world space already; the matrix beside them (4160h) only tells an editor where the pivot is.
enum Chunk : uint16_t {
  kMain = 0x4D4D,
  kEditor = 0x3D3D,
  kObject = 0x4000,
  kTriMesh = 0x4100,
  kVertices = 0x4110,
  kFaces = 0x4120
};

class TdsReader {
 public:
  explicit TdsReader(const std::string& where) : where_(where) {}

  Mesh read(std::string_view bytes) {
    ByteCursor cursor(bytes);
    if (!cursor.has(kChunkHeader) || cursor.value<uint16_t>() != kMain)
      throw Error({.where = where_,
                   .expected = "a 3DS file (first bytes 4D 4D)",
                   .found = "something else",
                   .todo = "check the file's extension"});
    readChunks(bytes);
    return std::move(mesh_);
  }

 private:
  static constexpr size_t kChunkHeader = 6;

  // The nesting is that of the format (four deep), since every level recognises only its own children.
  void readChunks(std::string_view bytes) {
    ByteCursor cursor(bytes);
    while (cursor.left() >= kChunkHeader) {
      const uint16_t id = cursor.value<uint16_t>();
      const size_t size = cursor.value<uint32_t>();
      if (size < kChunkHeader || !cursor.has(size - kChunkHeader))
        failTruncated(where_, "a 3DS chunk of " + std::to_string(size) + " bytes",
                      cursor.left() + kChunkHeader);
      readChunk(id, cursor.take(size - kChunkHeader));
    }
  }

  void readChunk(uint16_t id, std::string_view body) {
    if (std::pair(parent_, id) == std::pair(uint16_t{0}, uint16_t{kMain}) ||
        std::pair(parent_, id) == std::pair(uint16_t{kMain}, uint16_t{kEditor}))
      descend(id, body);
    else if (parent_ == kEditor && id == kObject)
      descend(id, body.substr(std::min(body.find('\0'), body.size() - 1) + 1));
    else if (parent_ == kObject && id == kTriMesh)
      readTriMesh(body);
    else if (parent_ == kTriMesh && id == kVertices)
      readVertices(body);
    else if (parent_ == kTriMesh && id == kFaces)
      readFaces(body);
  }

  void descend(uint16_t id, std::string_view body) {
    const uint16_t parent = std::exchange(parent_, id);
    readChunks(body);
    parent_ = parent;
  }

  // Faces count from their own mesh's first vertex; they are checked when all of the mesh is known.
  void readTriMesh(std::string_view body) {
    const size_t first_vertex = mesh_.positions.size(), first_face = mesh_.triangles.size();
    descend(kTriMesh, body);
    const size_t count = mesh_.positions.size() - first_vertex;
    for (size_t f = first_face; f < mesh_.triangles.size(); ++f) {
      glm::uvec3& corners = mesh_.triangles[f];
      for (int i = 0; i < 3; ++i) {
        if (corners[i] >= count)
          throw Error({.where = where_,
                       .expected = "corners below the vertex count of " + std::to_string(count),
                       .found = "index " + std::to_string(corners[i]) + " in face " + std::to_string(f),
                       .todo = "export the model again"});
        corners[i] += static_cast<uint32_t>(first_vertex);
      }
    }
  }

  size_t readCount(ByteCursor& cursor, size_t record, const char* what) {
    const size_t count = cursor.has(2) ? cursor.value<uint16_t>() : 0;
    if (!cursor.has(count * record))
      failTruncated(where_, std::to_string(count) + " " + what + " in a 3DS chunk", cursor.left());
    return count;
  }

  void readVertices(std::string_view body) {
    ByteCursor cursor(body);
    for (size_t left = readCount(cursor, 3 * sizeof(float), "vertices"); left > 0; --left) {
      const float x = cursor.value<float>(), y = cursor.value<float>(), z = cursor.value<float>();
      mesh_.positions.push_back({x, y, z});
    }
  }

  void readFaces(std::string_view body) {
    ByteCursor cursor(body);
    for (size_t left = readCount(cursor, 4 * sizeof(uint16_t), "faces"); left > 0; --left) {
      const uint32_t a = cursor.value<uint16_t>(), b = cursor.value<uint16_t>(), c = cursor.value<uint16_t>();
      cursor.take(sizeof(uint16_t));  // which edges an editor draws
      mesh_.triangles.push_back({a, b, c});
    }
  }

  const std::string& where_;
  Mesh mesh_;
  uint16_t parent_ = 0;
};

}  // namespace

Mesh read3ds(std::string_view bytes, const std::string& where) {
  return TdsReader(where).read(bytes);
}

}  // namespace lychnite
