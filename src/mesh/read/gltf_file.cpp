#include "mesh/read/gltf_file.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "lychnite/base/error.h"
#include "mesh/read/byte_cursor.h"
#include "mesh/read/file_bytes.h"

namespace lychnite {
namespace {

using nlohmann::json;

enum ComponentType : size_t {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126
};

size_t sizeOf(size_t component_type) {
  if (component_type == kByte || component_type == kUnsignedByte) return 1;
  if (component_type == kShort || component_type == kUnsignedShort) return 2;
  return component_type == kUnsignedInt || component_type == kFloat ? 4 : 0;
}

// The value, scaled as section 3.6.2.2 of the glTF 2.0 specification says when it is normalized.
double component(ByteCursor& cursor, size_t type, bool normalized) {
  const auto scaled = [normalized](double value, double most) {
    return normalized ? std::max(value / most, -1.0) : value;
  };
  switch (type) {
    case kByte:
      return scaled(cursor.value<int8_t>(), 127);
    case kUnsignedByte:
      return scaled(cursor.value<uint8_t>(), 255);
    case kShort:
      return scaled(cursor.value<int16_t>(), 32767);
    case kUnsignedShort:
      return scaled(cursor.value<uint16_t>(), 65535);
    case kUnsignedInt:
      return cursor.value<uint32_t>();
    default:
      return cursor.value<float>();
  }
}

size_t componentsOf(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "MAT4") return 16;
  if (type.size() == 4 && type.starts_with("VEC") && type[3] >= '2' && type[3] <= '4')
    return static_cast<size_t>(type[3] - '0');
  return 0;
}

// Nested deeper than any real file; guards everything that walks the document recursively.
bool nestedTooDeep(std::string_view text) {
  constexpr int kMost = 256;
  int depth = 0;
  bool in_string = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\')
      ++i;
    else if (c == '"')
      in_string = !in_string;
    else if (!in_string && (c == '[' || c == '{') && ++depth > kMost)
      return true;
    else if (!in_string && (c == ']' || c == '}'))
      --depth;
  }
  return false;
}

int base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::optional<std::string> decodeBase64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  while (text.ends_with('=')) text.remove_suffix(1);
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int digit = base64Digit(c);
    if (digit < 0) return std::nullopt;
    bits = bits << 6 | static_cast<uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xff);
  }
  return bytes;
}

std::string decodePercent(std::string_view uri) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : (c | 32) - 'a' + 10; };
  std::string text;
  for (size_t i = 0; i < uri.size(); ++i) {
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() &&
                         std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                         std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
    text += escaped ? static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2])) : uri[i];
    if (escaped) i += 2;
  }
  return text;
}

}  // namespace

GltfFile::GltfFile(std::string_view bytes, std::filesystem::path path)
    : path_(std::move(path)), bytes_read_(bytes.size()) {
  if (bytes.starts_with("glTF"))
    openBinary(bytes);
  else
    parse(bytes);
  loaded_.resize(document_.contains("buffers") ? document_["buffers"].size() : 0);
}

void GltfFile::openBinary(std::string_view bytes) {
  constexpr size_t kHeader = 12, kChunkHeader = 8;
  constexpr uint32_t kJson = 0x4E4F534A, kBin = 0x004E4942;
  if (bytes.size() < kHeader + kChunkHeader) failTruncated(path_.string(), "a GLB header", bytes.size());
  ByteCursor cursor(bytes.substr(4));
  if (const uint32_t version = cursor.value<uint32_t>(); version != 2)
    fail("glTF 2", "GLB version " + std::to_string(version), "convert it to glTF 2");
  if (const size_t length = cursor.value<uint32_t>(); length > bytes.size())
    failTruncated(path_.string(), std::to_string(length) + " bytes of GLB", bytes.size());
  for (bool first = true; cursor.left() >= kChunkHeader; first = false) {
    const size_t length = cursor.value<uint32_t>();
    const uint32_t type = cursor.value<uint32_t>();
    if (!cursor.has(length))
      failTruncated(path_.string(), "a GLB chunk of " + std::to_string(length) + " bytes", cursor.left());
    const std::string_view chunk = cursor.take(length);
    if (first && type != kJson) fail("a JSON chunk first", "another one", "export the model again");
    if (first) parse(chunk);
    if (type == kBin && binary_chunk_.empty()) binary_chunk_ = chunk;
  }
}

void GltfFile::parse(std::string_view text) {
  if (nestedTooDeep(text)) fail("a glTF document", "JSON nested hundreds deep");
  document_ = json::parse(text);
  if (!document_.is_object()) fail("a glTF document", "JSON that is no object");
  const std::string version = document_.at("asset").at("version").get<std::string>();
  if (!version.starts_with("2.")) fail("glTF 2", "version " + version.substr(0, 16), "convert it to glTF 2");
}

void GltfFile::fail(const std::string& expected, const std::string& found, const std::string& todo) const {
  throw Error({.where = path_.string(),
               .expected = expected,
               .found = found,
               .todo = todo.empty() ? "export the model again" : todo});
}

const json& GltfFile::item(const char* list, size_t index) const {
  const auto found = document_.find(list);
  const size_t count = found != document_.end() && found->is_array() ? found->size() : 0;
  if (index >= count) fail("an index below the " + std::to_string(count) + " " + list, std::to_string(index));
  return (*found)[index];
}

size_t GltfFile::whole(const json& object, const char* member, std::optional<size_t> fallback) const {
  const auto found = object.find(member);
  if (found == object.end() && fallback) return *fallback;
  if (found == object.end() || !found->is_number_unsigned())
    fail(std::string("a whole number \"") + member + "\"",
         found == object.end() ? "none"
                               : found->dump(-1, ' ', true, json::error_handler_t::replace).substr(0, 24));
  return found->get<size_t>();
}

std::string GltfFile::loadBuffer(const json& description) {
  const std::string uri = description.at("uri").get<std::string>();
  if (uri.starts_with("data:")) {
    constexpr std::string_view kMark = ";base64,";
    const size_t mark = uri.find(kMark);
    auto bytes =
        mark == uri.npos ? std::nullopt : decodeBase64(std::string_view(uri).substr(mark + kMark.size()));
    if (!bytes) fail("base64 in a data URI", "something else");
    return std::move(*bytes);
  }
  if (uri.find("://") != uri.npos)
    fail("buffers beside the file", "the address " + uri.substr(0, 80),
         "download the buffer and name its file");
  return readWholeFile(path_.parent_path() / decodePercent(uri));
}

std::string_view GltfFile::buffer(size_t index) {
  const json& description = item("buffers", index);
  std::string_view bytes = binary_chunk_;
  if (description.contains("uri")) {
    if (!loaded_[index]) {
      loaded_[index] = loadBuffer(description);
      bytes_read_ += loaded_[index]->size();
    }
    bytes = *loaded_[index];
  } else if (index != 0) {
    fail("a \"uri\" for buffer " + std::to_string(index), "none");
  }
  const size_t length = whole(description, "byteLength");
  if (length > bytes.size())
    failTruncated(path_.string(), std::to_string(length) + " bytes in buffer " + std::to_string(index),
                  bytes.size());
  return bytes.substr(0, length);
}

GltfFile::View GltfFile::view(size_t index) {
  const json& description = item("bufferViews", index);
  const std::string_view bytes = buffer(whole(description, "buffer"));
  const size_t offset = whole(description, "byteOffset", 0), length = whole(description, "byteLength");
  if (offset > bytes.size() || length > bytes.size() - offset)
    fail("buffer views within the " + std::to_string(bytes.size()) + " bytes of their buffer",
         "view " + std::to_string(index) + " of " + std::to_string(length) + " bytes at " +
             std::to_string(offset));
  return {bytes.substr(offset, length), whole(description, "byteStride", 0)};
}

void GltfFile::readDense(const View& view, size_t offset, const json& accessor, std::vector<double>& out) {
  const size_t type = whole(accessor, "componentType"), count = whole(accessor, "count");
  const size_t components = componentsOf(accessor.at("type").get<std::string>());
  const size_t element = sizeOf(type) * components;
  const size_t stride = view.stride == 0 ? element : view.stride;
  const size_t size = view.bytes.size();
  if (element == 0 || stride < element) fail("an accessor with a known layout", "another one");
  if (count == 0 || offset > size || element > size - offset ||
      count - 1 > (size - offset - element) / stride)
    fail("accessors within the " + std::to_string(size) + " bytes of their view",
         std::to_string(count) + " elements of " + std::to_string(stride) + " bytes at " +
             std::to_string(offset));
  const bool normalized = accessor.value("normalized", false);
  out.reserve(count * components);
  for (size_t i = 0; i < count; ++i) {
    ByteCursor cursor(view.bytes.substr(offset + i * stride, element));
    for (size_t c = 0; c < components; ++c) out.push_back(component(cursor, type, normalized));
  }
}

void GltfFile::applySparse(const json& accessor, std::vector<double>& out, size_t components) {
  const json& sparse = accessor.at("sparse");
  const json& indices = sparse.at("indices");
  const json& values = sparse.at("values");
  const size_t count = whole(sparse, "count");
  std::vector<double> where, what;
  const json where_accessor = {
      {"componentType", whole(indices, "componentType")}, {"count", count}, {"type", "SCALAR"}};
  json what_accessor = accessor;
  what_accessor["count"] = count;
  readDense(view(whole(indices, "bufferView")), whole(indices, "byteOffset", 0), where_accessor, where);
  readDense(view(whole(values, "bufferView")), whole(values, "byteOffset", 0), what_accessor, what);
  for (size_t i = 0; i < count; ++i) {
    if (!(where[i] >= 0 && where[i] < static_cast<double>(out.size() / components)))
      fail("sparse indices within their accessor", std::to_string(where[i]));
    std::copy_n(what.begin() + static_cast<ptrdiff_t>(i * components), components,
                out.begin() + static_cast<ptrdiff_t>(static_cast<size_t>(where[i]) * components));
  }
}

std::vector<double> GltfFile::numbers(size_t index, size_t components) {
  const json& accessor = item("accessors", index);
  const std::string type = accessor.at("type").get<std::string>();
  if (componentsOf(type) != components)
    fail("an accessor of " + std::to_string(components) + " components", type.substr(0, 24));
  const bool sparse = accessor.contains("sparse");
  std::vector<double> out;
  if (accessor.contains("bufferView")) {
    readDense(view(whole(accessor, "bufferView")), whole(accessor, "byteOffset", 0), accessor, out);
  } else if (sparse) {
    const size_t count = whole(accessor, "count");
    if (count > bytes_read_) fail("counts that the file can hold", std::to_string(count) + " zeros");
    out.assign(count * components, 0.0);
  } else {
    fail("geometry in buffers", "an accessor without a bufferView (compressed, perhaps)",
         "export the model without mesh compression");
  }
  if (sparse) applySparse(accessor, out, components);
  return out;
}

std::vector<glm::vec3> GltfFile::vectors(size_t accessor) {
  const std::vector<double> values = numbers(accessor, 3);
  std::vector<glm::vec3> out(values.size() / 3);
  for (size_t i = 0; i < out.size(); ++i) out[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return out;
}

}  // namespace lychnite
