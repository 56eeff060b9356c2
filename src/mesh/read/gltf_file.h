#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lychnite {

/// A glTF 2.0 file's document with checked access to its binary data. All of it throws Error, or the
/// exceptions of nlohmann::json for missing or mistyped members; readGltf turns those into Error.
class GltfFile {
 public:
  /// `bytes` must outlive this: the BIN chunk is not copied.
  GltfFile(std::string_view bytes, std::filesystem::path path);

  const nlohmann::json& document() const { return document_; }
  /// Bytes of the file and of the buffers read so far: what counts may be measured against.
  size_t bytesRead() const { return bytes_read_; }

  /// document()[list][index], refusing an index past the list.
  const nlohmann::json& item(const char* list, size_t index) const;
  /// A member that must be a whole number of zero or more; without it `fallback`, or an Error.
  size_t whole(const nlohmann::json& object, const char* member, std::optional<size_t> fallback = {}) const;

  /// An accessor of `components` numbers an element, as doubles side by side (normalized ones scaled).
  std::vector<double> numbers(size_t accessor, size_t components);
  std::vector<glm::vec3> vectors(size_t accessor);

  [[noreturn]] void fail(const std::string& expected, const std::string& found,
                         const std::string& todo = {}) const;

 private:
  struct View {
    std::string_view bytes;
    size_t stride = 0;  // 0: tightly packed
  };
  void openBinary(std::string_view bytes);
  void parse(std::string_view text);
  View view(size_t index);
  std::string_view buffer(size_t index);
  std::string loadBuffer(const nlohmann::json& description);
  void readDense(const View& view, size_t offset, const nlohmann::json& accessor, std::vector<double>& out);
  void applySparse(const nlohmann::json& accessor, std::vector<double>& out, size_t components);

  std::filesystem::path path_;
  std::string_view binary_chunk_;
  nlohmann::json document_;
  size_t bytes_read_ = 0;
  std::vector<std::optional<std::string>> loaded_;  // the buffers that are not the BIN chunk
};

}  // namespace lychnite
