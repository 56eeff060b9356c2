#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <utility>

#include "lychnite/base/error.h"
#include "mesh/read/byte_cursor.h"
#include "mesh/read/polygons.h"
#include "mesh/read/readers.h"
#include "mesh/read/text_lines.h"

namespace lychnite {
namespace {

// PLY (Turk, "The PLY Polygon File Format", 1994).
enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

constexpr size_t sizeOf(Type type) {
  constexpr std::array<size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<size_t>(type)];
}

std::optional<Type> typeNamed(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames = {{{"char", "int8"},
                                                                      {"uchar", "uint8"},
                                                                      {"short", "int16"},
                                                                      {"ushort", "uint16"},
                                                                      {"int", "int32"},
                                                                      {"uint", "uint32"},
                                                                      {"float", "float32"},
                                                                      {"double", "float64"}}};
  for (size_t i = 0; i < kNames.size(); ++i)
    if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<Type>(i);
  return std::nullopt;
}

struct Property {
  std::string name;
  Type type = Type::kFloat;
  std::optional<Type> count_type;  // of a list
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { kText, kLittle, kBig };

struct Header {
  Encoding encoding = Encoding::kText;
  std::vector<Element> elements;
};

std::string shortNumber(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

// Where the values come from, record by record. All of PLY's types fit a double exactly.
class Source {
 public:
  virtual ~Source() = default;
  virtual void beginRecord(const Element& element) = 0;
  virtual double value(Type type) = 0;
  virtual size_t bytesLeft() const = 0;
  virtual size_t leastBytes(Type type) const = 0;
};

class TextSource : public Source {
 public:
  TextSource(TextLines lines, const std::string& where) : lines_(lines), words_("", where, 0) {}

  void beginRecord(const Element& element) override {
    words_ = lines_.fullLine('\0', ("another \"" + element.name + "\"").c_str());
  }
  double value(Type) override { return words_.number(); }
  size_t bytesLeft() const override { return words_.rest().size() + lines_.bytesLeft() + 1; }
  size_t leastBytes(Type) const override { return 2; }  // a digit and a blank

 private:
  TextLines lines_;
  Words words_;
};

class BinarySource : public Source {
 public:
  BinarySource(std::string_view bytes, std::endian order, const std::string& where)
      : cursor_(bytes, order), where_(where) {}

  void beginRecord(const Element& element) override { element_ = &element; }
  double value(Type type) override {
    if (!cursor_.has(sizeOf(type)))
      failTruncated(where_, "another \"" + element_->name + "\"", cursor_.left());
    switch (type) {
      case Type::kInt8:
        return cursor_.value<int8_t>();
      case Type::kUint8:
        return cursor_.value<uint8_t>();
      case Type::kInt16:
        return cursor_.value<int16_t>();
      case Type::kUint16:
        return cursor_.value<uint16_t>();
      case Type::kInt32:
        return cursor_.value<int32_t>();
      case Type::kUint32:
        return cursor_.value<uint32_t>();
      case Type::kFloat:
        return cursor_.value<float>();
      case Type::kDouble:
        return cursor_.value<double>();
    }
    return 0;
  }
  size_t bytesLeft() const override { return cursor_.left(); }
  size_t leastBytes(Type type) const override { return sizeOf(type); }

 private:
  ByteCursor cursor_;
  const std::string& where_;
  const Element* element_ = nullptr;
};

Encoding readEncoding(Words& words) {
  const std::string_view name = words.next();
  if (name == "ascii") return Encoding::kText;
  if (name == "binary_little_endian") return Encoding::kLittle;
  if (name != "binary_big_endian") words.fail("ascii, binary_little_endian or binary_big_endian", name);
  return Encoding::kBig;
}

Type readType(Words& words) {
  const std::string_view name = words.next();
  const std::optional<Type> type = typeNamed(name);
  if (!type) words.fail("a PLY type", name);
  return *type;
}

Property readProperty(Words& words) {
  Property property;
  if (Words ahead = words; ahead.next() == "list") {
    words.next();
    property.count_type = readType(words);
    if (*property.count_type >= Type::kFloat) words.fail("a whole type for a list's count", "float");
  }
  property.type = readType(words);
  property.name = words.next();
  return property;
}

Header readHeader(TextLines& lines, const std::string& where) {
  if (const Words first = lines.line(); first.rest() != "ply")
    throw Error({.where = where,
                 .expected = "a PLY file (first line \"ply\")",
                 .found = "something else",
                 .todo = "check the file's extension"});
  Header header;
  bool has_format = false;
  for (;;) {
    Words words = lines.fullLine('\0', "\"end_header\"");
    const std::string_view keyword = words.next();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      header.encoding = readEncoding(words);
      has_format = true;
    } else if (keyword == "element") {
      std::string name(words.next());
      header.elements.push_back({std::move(name), words.count(), {}});
    } else if (keyword == "property") {
      if (header.elements.empty()) words.fail("an element before its properties", keyword);
      header.elements.back().properties.push_back(readProperty(words));
    } else if (keyword != "comment" && keyword != "obj_info") {
      words.fail("a line of a PLY header", keyword);
    }
  }
  if (!has_format)
    throw Error({.where = where,
                 .expected = "a \"format\" line in the header",
                 .found = "none",
                 .todo = "export it again"});
  return header;
}

// Refuses counts that the rest of the file cannot hold, before anything is allocated for them.
void checkCount(const Element& element, const Source& source, const std::string& where) {
  size_t least = 0;
  for (const Property& p : element.properties) least += source.leastBytes(p.count_type.value_or(p.type));
  if (element.count == 0) return;
  if (least == 0)
    throw Error({.where = where,
                 .expected = "properties for the element \"" + element.name + "\"",
                 .found = "none",
                 .todo = "export the model again"});
  if (element.count > source.bytesLeft() / least)
    failTruncated(where,
                  std::to_string(element.count) + " times \"" + element.name + "\", as the header says",
                  source.bytesLeft());
}

class PlyReader {
 public:
  PlyReader(Source& source, const std::string& where) : source_(source), where_(where) {}

  Mesh read(const Header& header) {
    for (const Element& element : header.elements) {
      checkCount(element, source_, where_);
      if (element.name == "vertex")
        readVertices(element);
      else if (element.name == "face")
        readFaces(element);
      else
        readRecords(element, [](size_t, double) {});
    }
    return triangulate(std::move(polygons_), where_);
  }

 private:
  // Calls visit(property, value) for each value of each record; lists tell their values one by one.
  template <typename Visit, typename Done>
  void readRecords(const Element& element, Visit&& visit, Done&& done) {
    for (uint64_t i = 0; i < element.count; ++i) {
      source_.beginRecord(element);
      for (size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        const uint64_t size = property.count_type ? listSize(element, property, i) : 1;
        for (uint64_t k = 0; k < size; ++k) visit(p, source_.value(property.type));
      }
      done();
    }
  }
  template <typename Visit>
  void readRecords(const Element& element, Visit&& visit) {
    readRecords(element, visit, [] {});
  }

  uint64_t listSize(const Element& element, const Property& property, uint64_t record) {
    const double size = source_.value(*property.count_type);
    const double most = static_cast<double>(source_.bytesLeft() / source_.leastBytes(property.type));
    if (!(size >= 0) || size != std::floor(size) || size > most)
      throw Error({.where = where_,
                   .expected = "a list that the rest of the file can hold",
                   .found = shortNumber(size) + " values in " + element.name + " " + std::to_string(record),
                   .todo = "the file is truncated or malformed: download or export it again"});
    return static_cast<uint64_t>(size);
  }

  void readVertices(const Element& element) {
    constexpr std::array<std::string_view, 6> kNames = {"x", "y", "z", "nx", "ny", "nz"};
    constexpr size_t kElsewhere = kNames.size();
    std::vector<size_t> target(element.properties.size(), kElsewhere);
    std::array<bool, 7> has{};
    for (size_t p = 0; p < target.size(); ++p) {
      if (element.properties[p].count_type) continue;
      target[p] = static_cast<size_t>(std::find(kNames.begin(), kNames.end(), element.properties[p].name) -
                                      kNames.begin());
      has[target[p]] = true;
    }
    if (!has[0] || !has[1] || !has[2])
      throw Error({.where = where_,
                   .expected = "vertices with x, y and z",
                   .found = "other properties",
                   .todo = "export the model again"});
    const bool normals = has[3] && has[4] && has[5];
    polygons_.positions.reserve(element.count);
    if (normals) polygons_.normals.reserve(element.count);
    std::array<float, 7> values{};
    readRecords(
        element, [&](size_t p, double value) { values[target[p]] = static_cast<float>(value); },
        [&] {
          polygons_.positions.emplace_back(values[0], values[1], values[2]);
          if (normals) polygons_.normals.emplace_back(values[3], values[4], values[5]);
        });
  }

  void readFaces(const Element& element) {
    size_t corners = element.properties.size();
    for (size_t p = 0; p < element.properties.size(); ++p) {
      const std::string& name = element.properties[p].name;
      if (element.properties[p].count_type && (name == "vertex_indices" || name == "vertex_index"))
        corners = p;
    }
    if (corners == element.properties.size())
      throw Error({.where = where_,
                   .expected = "faces with a list \"vertex_indices\"",
                   .found = "other properties",
                   .todo = "export the model again"});
    polygons_.sizes.reserve(element.count);
    size_t before = polygons_.corners.size();
    readRecords(
        element,
        [&](size_t p, double value) {
          if (p == corners) addCorner(value);
        },
        [&] {
          polygons_.sizes.push_back(static_cast<uint32_t>(polygons_.corners.size() - before));
          before = polygons_.corners.size();
        });
  }

  void addCorner(double value) {
    constexpr double kMost = std::numeric_limits<uint32_t>::max();
    if (!(value >= 0 && value <= kMost) || value != std::floor(value))
      throw Error({.where = where_,
                   .expected = "vertex indices from 0",
                   .found = shortNumber(value) + " in face " + std::to_string(polygons_.sizes.size()),
                   .todo = "export the model again"});
    polygons_.corners.push_back(static_cast<uint32_t>(value));
  }

  Source& source_;
  const std::string& where_;
  Polygons polygons_;
};

}  // namespace

Mesh readPly(std::string_view bytes, const std::string& where) {
  TextLines lines(bytes, where);
  const Header header = readHeader(lines, where);
  if (header.encoding == Encoding::kText) {
    TextSource source(lines, where);
    return PlyReader(source, where).read(header);
  }
  const std::endian order = header.encoding == Encoding::kBig ? std::endian::big : std::endian::little;
  BinarySource source(bytes.substr(lines.offset()), order, where);
  return PlyReader(source, where).read(header);
}

}  // namespace lychnite
