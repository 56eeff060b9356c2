#include "mesh/read/byte_cursor.h"
#include "mesh/read/readers.h"
#include "mesh/read/text_lines.h"

namespace lychnite {
namespace {

constexpr size_t kHeader = 84, kRecord = 50;  // 80 bytes of anything and a count; normal, 3 corners, 2 bytes

size_t recordCount(std::string_view bytes) {
  return ByteCursor(bytes.substr(80, 4)).value<uint32_t>();
}

// An ASCII file begins with "solid", but so do the free 80 bytes of many binary ones; the size decides.
bool isBinary(std::string_view bytes) {
  if (bytes.size() >= kHeader && bytes.size() == kHeader + kRecord * recordCount(bytes)) return true;
  return !bytes.starts_with("solid") || bytes.substr(0, kHeader).find('\0') != bytes.npos;
}

void addTriangle(Mesh& mesh) {
  const uint32_t first = static_cast<uint32_t>(mesh.positions.size() - 3);
  mesh.triangles.push_back({first, first + 1, first + 2});
}

Mesh readBinary(std::string_view bytes, const std::string& where) {
  if (bytes.size() < kHeader)
    failTruncated(where, "an STL file (\"solid\", or a binary header of 84 bytes)", bytes.size());
  const size_t count = recordCount(bytes);
  if (bytes.size() < kHeader + kRecord * count)
    failTruncated(where,
                  std::to_string(kHeader + kRecord * count) + " bytes of binary STL for the " +
                      std::to_string(count) + " triangles of the header",
                  bytes.size());
  Mesh mesh;
  mesh.positions.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (size_t t = 0; t < count; ++t) {
    ByteCursor record(bytes.substr(kHeader + kRecord * t, kRecord));
    record.take(3 * sizeof(float));  // the facet's normal says nothing that its corners do not
    for (int i = 0; i < 3; ++i) {
      const float x = record.value<float>(), y = record.value<float>(), z = record.value<float>();
      mesh.positions.push_back({x, y, z});
    }
    addTriangle(mesh);
  }
  return mesh;
}

glm::vec3 readVertex(TextLines& lines) {
  Words words = lines.fullLine('\0', "a \"vertex\" line");
  if (const auto word = words.next(); word != "vertex") words.fail("\"vertex\" and three numbers", word);
  const double x = words.number(), y = words.number(), z = words.number();
  return {x, y, z};
}

void readFacet(TextLines& lines, Mesh& mesh) {
  Words outer = lines.fullLine('\0', "an \"outer loop\" line");
  if (const auto word = outer.next(); word != "outer") outer.fail("\"outer loop\"", word);
  for (int i = 0; i < 3; ++i) mesh.positions.push_back(readVertex(lines));
  for (const char* closing : {"endloop", "endfacet"}) {
    Words words = lines.fullLine('\0', "a facet's end");
    if (const auto word = words.next(); word != closing) words.fail(std::string("\"") + closing + "\"", word);
  }
  addTriangle(mesh);
}

Mesh readText(std::string_view bytes, const std::string& where) {
  Mesh mesh;
  TextLines lines(bytes, where);
  bool open = true;
  lines.fullLine('\0', "\"solid\"");
  while (open) {
    Words words = lines.fullLine('\0', "a facet or \"endsolid\"");
    const std::string_view word = words.next();
    if (word == "facet")
      readFacet(lines, mesh);
    else if (word == "endsolid")
      open = false;
    else
      words.fail("\"facet\" or \"endsolid\"", word);
    while (!open && !lines.atEnd())  // further solids become part of the one mesh
      if (lines.line().next() == "solid") open = true;
  }
  return mesh;
}

}  // namespace

Mesh readStl(std::string_view bytes, const std::string& where) {
  return isBinary(bytes) ? readBinary(bytes, where) : readText(bytes, where);
}

}  // namespace lychnite
