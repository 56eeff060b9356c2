#include "lychnite/base/error.h"
#include "lychnite/optics/profile.h"

namespace lychnite {

std::unique_ptr<Profile> makeProfile(ProfileKind kind, const Coefficients& coefficients) {
  switch (kind) {
    case ProfileKind::kDipole:
      return makeDipole(coefficients);
    case ProfileKind::kBetterDipole:
      return makeBetterDipole(coefficients);
    case ProfileKind::kNormalizedDiffusion:
      return makeNormalizedDiffusion(coefficients);
    case ProfileKind::kTabulated:
      break;
  }
  throw Error({.where = "profile tabulated",
               .expected = "a table measured by the transport",
               .found = "only the material",
               .todo = "use dipole, better-dipole or normalized-diffusion"},
              Error::Kind::kUsage);
}

}  // namespace lychnite
