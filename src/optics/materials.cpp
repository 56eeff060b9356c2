#include "lychnite/optics/materials.h"

#include <fmt/format.h>

#include <vector>

#include "lychnite/base/error.h"
#include "lychnite/base/text.h"

namespace lychnite {
namespace {

/// Reduced scattering and absorption in 1/mm as tabulated in [J01] (sigma_sp with g = 0 makes the same
/// medium).
NamedCoefficients jensen(const char* name, Rgb sigma_sp, Rgb sigma_a, double eta) {
  return {name, {.sigma_s = sigma_sp, .sigma_a = sigma_a, .g = 0, .eta = eta}, "Jensen2001"};
}

}  // namespace

std::span<const NamedCoefficients> materialLibrary() {
  static const std::vector<NamedCoefficients> library{
      jensen("apple", {2.29, 2.39, 1.97}, {.0030, .0034, .046}, 1.3),
      jensen("chicken1", {.15, .21, .38}, {.015, .077, .19}, 1.3),
      jensen("chicken2", {.19, .25, .32}, {.018, .088, .20}, 1.3),
      jensen("cream", {7.38, 5.47, 3.15}, {.0002, .0028, .0163}, 1.3),
      {"fig6",
       {.sigma_s = {1.63, 2.41, 3.44}, .sigma_a = {.0125, .0206, .0487}, .g = 0, .eta = 1.3},
       "YaoWang2009"},
      jensen("ketchup", {.18, .07, .03}, {.061, .97, 1.45}, 1.3),
      jensen("marble", {2.19, 2.62, 3.00}, {.0021, .0041, .0071}, 1.5),
      jensen("potato", {.68, .70, .55}, {.0024, .0090, .12}, 1.3),
      jensen("skimmilk", {.70, 1.22, 1.90}, {.0014, .0025, .0142}, 1.3),
      jensen("skin1", {.74, .88, 1.01}, {.032, .17, .48}, 1.3),
      jensen("skin2", {1.09, 1.59, 1.79}, {.013, .070, .145}, 1.3),
      jensen("spectralon", {11.6, 20.4, 14.9}, {0, 0, 0}, 1.3),
      jensen("wholemilk", {2.55, 3.21, 3.77}, {.0011, .0024, .014}, 1.3),
  };
  return library;
}

const NamedCoefficients& findMaterial(std::string_view name, std::string_view where) {
  std::vector<std::string> names;
  for (const NamedCoefficients& material : materialLibrary()) {
    if (material.name == name) return material;
    names.push_back(material.name);
  }
  const std::string nearest = nearestName(name, names);
  throw Error({.where = std::string(where),
               .expected = "",
               .found = fmt::format("there is no material '{}'", name),
               .todo = nearest.empty() ? "`lychnite materials` lists them"
                                       : fmt::format("did you mean '{}'?", nearest)},
              Error::Kind::kUsage);
}

}  // namespace lychnite
