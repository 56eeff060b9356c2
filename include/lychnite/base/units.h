#pragma once

#include <string>
#include <string_view>

namespace lychnite {

/// Parses a length with a unit: "20mm", "3 cm", "0.5m", "200um", "1in", "2ft". Returns millimetres, which may
/// be negative or zero (callers that need more say so). Throws Error (Kind::kUsage) naming `where` for a bare
/// number, an unknown unit, trailing text, NaN or infinity.
double parseLength(std::string_view text, std::string_view where);

/// Shortest pleasant form of a length in mm: 0.25 -> "0.25 mm", 30 -> "30 mm", 500 -> "50 cm", 2000 -> "2 m".
std::string formatLength(double mm);

/// Parses a finite number, all of `text`. Throws Error (Kind::kUsage) naming `where`.
double parseNumber(std::string_view text, std::string_view where);

}  // namespace lychnite
