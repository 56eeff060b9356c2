#include <stdexcept>

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
  }
  throw std::logic_error("a profile kind without a model");
}

}  // namespace lychnite
