#include "technique/multiple/spiral.h"

#include <gtest/gtest.h>

#include "lychnite/optics/materials.h"

namespace lychnite {
namespace {

TEST(Spiral, ReachLeavesAThousandthOfTheChannelThatReachesFarthest) {
  for (const char* material : {"marble", "ketchup", "skin1"}) {
    const auto profile = makeProfile(ProfileKind::kDipole, findMaterial(material, "").coefficients);
    const double reach = spiralReach(*profile);
    const Rgb all = profile->P(0), left = profile->P(reach), before = profile->P(reach / 1.21);
    double most = 0, mostBefore = 0;
    for (int c = 0; c < 3; ++c) {
      most = std::max(most, left[c] / all[c]);
      mostBefore = std::max(mostBefore, before[c] / all[c]);
    }
    EXPECT_LE(most, 1e-3) << material;
    EXPECT_GT(mostBefore, 1e-3) << material << ": not much farther than it has to be";
  }
}

TEST(Spiral, AChannelThatDoesNotScatterDoesNotNarrowThePattern) {
  const Coefficients grey{.sigma_s = Rgb(2), .sigma_a = Rgb(0.1), .eta = 1.3};
  Coefficients red = grey;
  red.sigma_s = Rgb(2, 0, 0);
  EXPECT_NEAR(spiralScale(*makeProfile(ProfileKind::kDipole, red)),
              spiralScale(*makeProfile(ProfileKind::kDipole, grey)), 1e-12);
  EXPECT_NEAR(spiralScale(*makeProfile(ProfileKind::kDipole, grey)),
              3 * makeProfile(ProfileKind::kDipole, grey)->coreLength().x, 1e-12);
}

}  // namespace
}  // namespace lychnite
