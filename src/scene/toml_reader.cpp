#include "scene/toml_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include <cmath>
#include <sstream>
#include <vector>

#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/base/units.h"

namespace lychnite {
namespace {

std::string shown(const toml::node& node) {
  std::ostringstream stream;
  node.visit([&stream](const auto& value) { stream << value; });
  std::string text = stream.str();
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

}  // namespace

TomlReader::TomlReader(const toml::table& table, std::string file,
                       std::initializer_list<std::string_view> known)
    : table_(table), file_(std::move(file)) {
  const std::vector<std::string> names(known.begin(), known.end());
  for (const auto& [key, node] : table_) {
    const std::string name(key.str());
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    const std::string nearest = nearestName(name, names);
    throw Error({.where = where(name),
                 .expected = "",
                 .found = "unknown key",
                 .todo = nearest.empty() ? fmt::format("known here: {}", fmt::join(names, ", "))
                                         : fmt::format("did you mean '{}'?", nearest)});
  }
}

std::string TomlReader::place() const {
  return fmt::format("{}:{}", file_, table_.source().begin.line);
}

std::string TomlReader::where(std::string_view key) const {
  const toml::node* found = table_.get(key);
  const auto line = found ? found->source().begin.line : table_.source().begin.line;
  return fmt::format("{}:{}: {}", file_, line, key);
}

void TomlReader::refuse(std::string_view key, std::string expected) const {
  const toml::node* found = table_.get(key);
  throw Error({.where = where(key),
               .expected = std::move(expected),
               .found = found ? shown(*found) : "nothing",
               .todo = ""});
}

double TomlReader::elementNumber(std::string_view key, const toml::node& node) const {
  const auto value = node.value<double>();
  if (!value || !std::isfinite(*value)) refuse(key, "a finite number");
  return *value;
}

double TomlReader::number(std::string_view key, double fallback) const {
  const toml::node* found = table_.get(key);
  return found ? elementNumber(key, *found) : fallback;
}

bool TomlReader::boolean(std::string_view key, bool fallback) const {
  const toml::node* found = table_.get(key);
  if (!found) return fallback;
  const auto value = found->value_exact<bool>();
  if (!value) refuse(key, "true or false");
  return *value;
}

std::string TomlReader::text(std::string_view key, const std::string& fallback) const {
  return table_.contains(key) ? text(key) : fallback;
}

std::string TomlReader::text(std::string_view key) const {
  const toml::node* found = table_.get(key);
  const auto value = found ? found->value_exact<std::string>() : std::nullopt;
  if (!value) refuse(key, "a text in quotes");
  return *value;
}

double TomlReader::length(std::string_view key, double fallback) const {
  const toml::node* found = table_.get(key);
  if (!found) return fallback;
  const auto value = found->value_exact<std::string>();
  if (!value) refuse(key, "a length with a unit in quotes (\"20mm\")");
  return parseLength(*value, where(key));
}

glm::dvec3 TomlReader::numbers(std::string_view key, glm::dvec3 fallback) const {
  const toml::node* found = table_.get(key);
  if (!found) return fallback;
  if (found->is_number()) return glm::dvec3(elementNumber(key, *found));
  const toml::array* list = found->as_array();
  if (!list || list->size() != 3) refuse(key, "three numbers");
  return {elementNumber(key, (*list)[0]), elementNumber(key, (*list)[1]), elementNumber(key, (*list)[2])};
}

glm::dvec3 TomlReader::lengths(std::string_view key, glm::dvec3 fallback) const {
  const toml::node* found = table_.get(key);
  if (!found) return fallback;
  const toml::array* list = found->as_array();
  if (!list || list->size() != 3) refuse(key, "three lengths ([\"0mm\", \"5mm\", \"0mm\"])");
  glm::dvec3 result;
  for (int i = 0; i < 3; ++i) {
    const auto value = (*list)[size_t(i)].value_exact<std::string>();
    if (!value) refuse(key, "three lengths with units in quotes");
    result[i] = parseLength(*value, where(key));
  }
  return result;
}

const toml::table* TomlReader::table(std::string_view key) const {
  const toml::node* found = table_.get(key);
  if (!found) return nullptr;
  if (!found->is_table()) refuse(key, "a table");
  return found->as_table();
}

const toml::array* TomlReader::array(std::string_view key) const {
  const toml::node* found = table_.get(key);
  if (!found) return nullptr;
  const toml::array* list = found->as_array();
  if (!list || !list->is_array_of_tables()) refuse(key, fmt::format("tables written as [[{}]]", key));
  return list;
}

}  // namespace lychnite
