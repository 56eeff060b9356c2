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
               .expected = "a maker of measured profiles (ProfileStore)",
               .found = "formulas only",
               .todo = "render through ImageMaker, or set the options' `profiles`"},
              Error::Kind::kUsage);
}

std::unique_ptr<Profile> makeProfile(const ProfileMaker& maker, const ProfileRequest& request,
                                     const Progress& progress) {
  return maker ? maker(request, progress) : makeProfile(request.kind, request.medium);
}

}  // namespace lychnite
