#include <algorithm>
#include <optional>
#include <unordered_map>

#include "lychnite/base/error.h"
#include "mesh/read/polygons.h"
#include "mesh/read/readers.h"
#include "mesh/read/text_lines.h"

namespace lychnite {
namespace {

struct Corner {
  uint32_t position = 0;
  std::optional<uint32_t> normal;
};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& where) : lines_(bytes, where), where_(where) {}

  Mesh read() {
    while (!lines_.atEnd()) readLine();
    if (polygons_.positions.empty())
      throw Error({.where = where_,
                   .expected = "an OBJ file with vertices (lines \"v x y z\")",
                   .found = "none",
                   .todo = "check the file and its extension"});
    if (normals_whole_ && !file_normals_.empty()) splitAtNormals();
    return triangulate(std::move(polygons_), where_);
  }

 private:
  void readLine() {
    std::string joined;
    Words words = logicalLine(joined);
    const std::string_view keyword = words.next();
    if (keyword == "v") polygons_.positions.push_back(readVector(words));
    if (keyword == "vn") file_normals_.push_back(readVector(words));
    if (keyword == "f") readFace(words);
  }

  // A line that ends in a backslash goes on in the next one.
  Words logicalLine(std::string& joined) {
    Words words = lines_.line();
    if (words.rest().find('\0') != std::string_view::npos)
      words.fail("the text of an OBJ file", "binary data");
    if (!words.rest().ends_with('\\')) return words;
    const size_t number = words.lineNumber();
    while (words.rest().ends_with('\\')) {
      joined += words.rest().substr(0, words.rest().size() - 1);
      joined += ' ';
      if (lines_.atEnd()) return {joined, where_, number};
      words = lines_.line();
    }
    joined += words.rest();
    return {joined, where_, number};
  }

  static glm::vec3 readVector(Words& words) {
    const double x = words.number(), y = words.number(), z = words.number();
    return {x, y, z};
  }

  void readFace(Words& words) {
    uint32_t size = 0;
    for (std::string_view word = words.next(); !word.empty() && word[0] != '#'; word = words.next(), ++size) {
      const Corner corner = readCorner(word, words);
      polygons_.corners.push_back(corner.position);
      if (corner.normal)
        corner_normals_.push_back(*corner.normal);
      else
        normals_whole_ = false;
    }
    if (size < 3) words.fail("a face of three corners or more", std::to_string(size));
    polygons_.sizes.push_back(size);
  }

  // "7", "7/2", "7//3" or "7/2/3": position, texture and normal.
  Corner readCorner(std::string_view word, const Words& line) const {
    const size_t slash = std::min(word.find('/'), word.size());
    const size_t second = std::min(word.find('/', slash + 1), word.size());
    Corner corner;
    corner.position = index(word.substr(0, slash), polygons_.positions.size(), "vertices", line);
    if (second < word.size())
      corner.normal = index(word.substr(second + 1), file_normals_.size(), "normals", line);
    return corner;
  }

  // Counts from 1, or from the end when negative.
  uint32_t index(std::string_view word, size_t count, const char* what, const Words& line) const {
    Words digits(word, where_, line.lineNumber());
    const int64_t value = digits.integer();
    const int64_t at = value < 0 ? static_cast<int64_t>(count) + value : value - 1;
    if (value == 0 || at < 0 || at >= static_cast<int64_t>(count))
      line.fail("an index within the " + std::to_string(count) + " " + what + " before it", word);
    return static_cast<uint32_t>(at);
  }

  // One vertex for each pair of position and normal that a face uses; positions that none uses stay.
  void splitAtNormals() {
    Polygons split;
    std::unordered_map<uint64_t, uint32_t> made;
    std::vector<bool> used(polygons_.positions.size(), false);
    for (size_t c = 0; c < polygons_.corners.size(); ++c) {
      const uint32_t position = polygons_.corners[c], normal = corner_normals_[c];
      used[position] = true;
      const auto [at, is_new] =
          made.try_emplace(uint64_t{position} << 32 | normal, static_cast<uint32_t>(split.positions.size()));
      if (is_new) addVertex(split, position, file_normals_[normal]);
      split.corners.push_back(at->second);
    }
    for (uint32_t v = 0; v < used.size(); ++v)
      if (!used[v]) addVertex(split, v, glm::vec3(0, 1, 0));
    split.sizes = std::move(polygons_.sizes);
    polygons_ = std::move(split);
  }

  void addVertex(Polygons& split, uint32_t position, const glm::vec3& normal) const {
    split.positions.push_back(polygons_.positions[position]);
    split.normals.push_back(normal);
  }

  TextLines lines_;
  const std::string& where_;
  Polygons polygons_;
  std::vector<glm::vec3> file_normals_;
  std::vector<uint32_t> corner_normals_;
  bool normals_whole_ = true;  // every corner so far has a normal
};

}  // namespace

Mesh readObj(std::string_view bytes, const std::string& where) {
  return ObjReader(bytes, where).read();
}

}  // namespace lychnite
