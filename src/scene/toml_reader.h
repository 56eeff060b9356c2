#pragma once

#include <glm/vec3.hpp>
#include <initializer_list>
#include <string>
#include <string_view>

// Exceptions of toml++ are turned into lychnite::Error where the text is parsed.
#include <toml++/toml.h>

namespace lychnite {

/// One table of a scene file: typed access with errors that name file, line and key.
class TomlReader {
 public:
  /// Throws Error for a key that is not among `known`, suggesting the nearest.
  TomlReader(const toml::table& table, std::string file, std::initializer_list<std::string_view> known);

  bool has(std::string_view key) const { return table_.contains(key); }
  double number(std::string_view key, double fallback) const;
  bool boolean(std::string_view key, bool fallback) const;
  std::string text(std::string_view key, const std::string& fallback) const;
  /// Required text.
  std::string text(std::string_view key) const;
  double length(std::string_view key, double fallback) const;           ///< mm, from "20mm"
  glm::dvec3 numbers(std::string_view key, glm::dvec3 fallback) const;  ///< of three, or one for all three
  glm::dvec3 lengths(std::string_view key, glm::dvec3 fallback) const;  ///< mm, of three
  const toml::table* table(std::string_view key) const;
  const toml::array* array(std::string_view key) const;
  const toml::node* node(std::string_view key) const { return table_.get(key); }

  /// "file:line" of the table.
  std::string place() const;
  /// "file:line: key".
  std::string where(std::string_view key) const;
  [[noreturn]] void refuse(std::string_view key, std::string expected) const;

 private:
  double elementNumber(std::string_view key, const toml::node& node) const;
  const toml::table& table_;
  std::string file_;
};

}  // namespace lychnite
