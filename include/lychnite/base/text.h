#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lychnite {

/// Splits at every `separator`; "a,,b" gives three parts, "" gives one empty part.
std::vector<std::string> split(std::string_view text, char separator);

/// The candidate nearest to `name` by edit distance (case ignored), or "" when none is near enough to be
/// meant.
std::string nearestName(std::string_view name, std::span<const std::string> candidates);

/// `text` as a basic string of TOML, in quotes.
std::string tomlString(std::string_view text);

}  // namespace lychnite
