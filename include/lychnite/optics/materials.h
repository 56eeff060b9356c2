#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lychnite/optics/coefficients.h"

namespace lychnite {

struct NamedCoefficients {
  std::string name;
  Coefficients coefficients;
  std::string source;  ///< key in docs/references.bib
};

/// The material library of docs/physics.md: the reduced coefficients of [J01]'s table (g = 0, so sigma_s =
/// sigma_sp) and "fig6" of Yao & Wang 2009, in alphabetical order.
std::span<const NamedCoefficients> materialLibrary();

/// Throws Error (Kind::kUsage) that suggests the nearest name.
const NamedCoefficients& findMaterial(std::string_view name, std::string_view where);

}  // namespace lychnite
