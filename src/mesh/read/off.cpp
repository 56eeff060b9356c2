#include "lychnite/base/error.h"
#include "mesh/read/byte_cursor.h"
#include "mesh/read/polygons.h"
#include "mesh/read/readers.h"
#include "mesh/read/text_lines.h"

namespace lychnite {
namespace {

// [ST][C][N]OFF: texture, colour and normal columns; 4OFF and nOFF (other dimensions) are no meshes of ours.
struct Columns {
  bool normals = false;
};

Columns readKeyword(Words& words) {
  const std::string_view keyword = words.next();
  std::string_view prefix = keyword;
  if (!prefix.ends_with("OFF")) words.fail("\"OFF\" (or NOFF, COFF, STOFF)", keyword);
  prefix.remove_suffix(3);
  if (prefix.starts_with("ST")) prefix.remove_prefix(2);
  if (prefix.starts_with("C")) prefix.remove_prefix(1);
  const bool normals = prefix == "N";
  if (!prefix.empty() && !normals) words.fail("\"OFF\" (or NOFF, COFF, STOFF)", keyword);
  return {normals};
}

void readVertices(TextLines& lines, const Columns& columns, uint64_t count, Polygons& polygons) {
  polygons.positions.reserve(count);
  if (columns.normals) polygons.normals.reserve(count);
  for (uint64_t v = 0; v < count; ++v) {
    Words words = lines.fullLine('#', "a vertex");
    const double x = words.number(), y = words.number(), z = words.number();
    polygons.positions.emplace_back(x, y, z);
    if (!columns.normals) continue;
    const double nx = words.number(), ny = words.number(), nz = words.number();
    polygons.normals.emplace_back(nx, ny, nz);
  }
}

void readFaces(TextLines& lines, uint64_t count, Polygons& polygons) {
  polygons.sizes.reserve(count);
  for (uint64_t f = 0; f < count; ++f) {
    Words words = lines.fullLine('#', "a face");
    const uint64_t size = words.count();
    if (size > words.rest().size()) words.fail("a face with its corners", std::to_string(size) + " corners");
    for (uint64_t i = 0; i < size; ++i) {
      const uint64_t corner = words.count();
      if (corner >= polygons.positions.size())
        words.fail("corners below the vertex count of " + std::to_string(polygons.positions.size()),
                   std::to_string(corner));
      polygons.corners.push_back(static_cast<uint32_t>(corner));
    }
    polygons.sizes.push_back(static_cast<uint32_t>(size));
  }
}

}  // namespace

Mesh readOff(std::string_view bytes, const std::string& where) {
  TextLines lines(bytes, where);
  Words words = lines.fullLine('#', "\"OFF\"");
  const Columns columns = readKeyword(words);
  if (words.rest().find_first_not_of(" \t\r") == std::string_view::npos)
    words = lines.fullLine('#', "the counts");
  if (Words copy = words; copy.next() == "BINARY") words.fail("a text OFF file", "BINARY");
  const uint64_t vertices = words.count(), faces = words.count();
  constexpr uint64_t kLeastVertex = 6, kLeastFace = 2;  // "0 0 0" and "0", with their line ends
  const size_t left = lines.bytesLeft() + 1;
  if (vertices > left / kLeastVertex || faces > left / kLeastFace)
    failTruncated(
        where,
        std::to_string(vertices) + " vertices and " + std::to_string(faces) + " faces, as the header says",
        bytes.size());
  Polygons polygons;
  readVertices(lines, columns, vertices, polygons);
  readFaces(lines, faces, polygons);
  return triangulate(std::move(polygons), where);
}

}  // namespace lychnite
