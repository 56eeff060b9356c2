#include "lychnite/base/units.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

struct Unit {
  std::string_view name;
  double mm;
};
constexpr std::array<Unit, 10> kUnits{{{"um", 1e-3},
                                       {"µm", 1e-3},
                                       {"mm", 1},
                                       {"cm", 10},
                                       {"dm", 100},
                                       {"km", 1e6},
                                       {"m", 1000},
                                       {"in", 25.4},
                                       {"ft", 304.8},
                                       {"\"", 25.4}}};

std::string_view trim(std::string_view text) {
  const char* blanks = " \t";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

[[noreturn]] void refuse(std::string_view where, std::string_view text, std::string todo) {
  throw Error({.where = std::string(where),
               .expected = "a length with a unit (20mm, 3cm, 1in)",
               .found = fmt::format("'{}'", text),
               .todo = std::move(todo)},
              Error::Kind::kUsage);
}

/// Parses the leading number; the rest of the text goes to `rest`. False when there is none or it is not
/// finite.
bool leadingNumber(std::string_view text, double& value, std::string_view& rest) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return false;
  rest = text.substr(size_t(end - text.data()));
  return true;
}

}  // namespace

double parseLength(std::string_view text, std::string_view where) {
  const std::string_view trimmed = trim(text);
  double value = 0;
  std::string_view rest;
  if (!leadingNumber(trimmed, value, rest)) refuse(where, text, "");
  rest = trim(rest);
  if (rest.empty())
    refuse(where, text, fmt::format("a bare number has no size: did you mean {}mm?", trimmed));
  for (const Unit& unit : kUnits)
    if (rest == unit.name) {
      const double mm = value * unit.mm;
      if (!std::isfinite(mm)) refuse(where, text, "the number is too large");
      return mm;
    }
  refuse(where, text, "known units are um, mm, cm, dm, m, km, in and ft");
}

std::string formatLength(double mm) {
  const double a = std::abs(mm);
  if (a == 0) return "0 mm";
  if (a < 0.1) return fmt::format("{:.4g} um", mm * 1e3);
  if (a < 100) return fmt::format("{:.4g} mm", mm);
  if (a < 1000) return fmt::format("{:.4g} cm", mm / 10);
  return fmt::format("{:.4g} m", mm / 1000);
}

double parseNumber(std::string_view text, std::string_view where) {
  double value = 0;
  std::string_view rest;
  if (!leadingNumber(trim(text), value, rest) || !rest.empty())
    throw Error(
        {.where = std::string(where), .expected = "a number", .found = fmt::format("'{}'", text), .todo = ""},
        Error::Kind::kUsage);
  return value;
}

}  // namespace lychnite
