#include "technique/multiple/lattice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lychnite/optics/materials.h"

namespace lychnite {
namespace {

TEST(Lattice, IsSevenBySevenAboutTheReceiver) {
  const auto cells = makeLattice(0, 9);
  float sumX = 0, sumY = 0;
  for (int i = 0; i < 49; ++i) {
    const glm::vec4& cell = cells[size_t(i)];
    EXPECT_EQ(cell.x, float(i % 7 - 3));
    EXPECT_EQ(cell.y, float(i / 7 - 3));
    EXPECT_EQ(cell.z, 0);
    EXPECT_EQ(cell.w, 1);
    sumX += cell.x;
    sumY += cell.y;
  }
  EXPECT_EQ(sumX, 0);
  EXPECT_EQ(sumY, 0);
}

TEST(Lattice, LevelsFollowTheRoundedDistance) {
  // Eq. 4 with alpha K = 1: n = round(|x|); eq. 5 to 9: offset 2^n x, area 4^n texels.
  for (const glm::vec4& cell : makeLattice(1, 9)) {
    const float step = std::exp2(cell.z);
    const float x = cell.x / step, y = cell.y / step;
    EXPECT_EQ(x, std::round(x));
    EXPECT_EQ(cell.z, std::round(std::sqrt(x * x + y * y)));
    EXPECT_EQ(cell.w, step * step);
  }
  EXPECT_EQ(makeLattice(1, 9)[24], glm::vec4(0, 0, 0, 1)) << "the middle is the receiver's own texel";
  EXPECT_EQ(makeLattice(1, 9)[0], glm::vec4(-48, -48, 4, 256)) << "the corner: sqrt(18) rounds to 4";
}

TEST(Lattice, LevelsStayInTheChain) {
  for (double slope : {-5.0, 0.3, 2.0, 100.0})
    for (const glm::vec4& cell : makeLattice(slope, 6)) {
      EXPECT_GE(cell.z, 0);
      EXPECT_LE(cell.z, 6);
    }
  EXPECT_EQ(makeLattice(-5, 6)[0].z, 0);
  EXPECT_EQ(makeLattice(100, 6)[0].z, 6);
}

TEST(Lattice, ReferenceSizeIsTenMillimetresInThePapersMaterial) {
  const Coefficients fig6 = findMaterial("fig6", "").coefficients;
  EXPECT_NEAR(latticeReferenceSize(fig6), 10, 0.5);
  EXPECT_NEAR(latticeReferenceSize(fig6.scaled(3)), 3 * latticeReferenceSize(fig6), 1e-9);
  EXPECT_GT(latticeReferenceSize(Coefficients{}), 0) << "an empty medium has none, and must not divide by 0";
}

TEST(Lattice, SlopeFallsByC2WithEachDoubling) {
  const Coefficients fig6 = findMaterial("fig6", "").coefficients;
  const LatticeConstants constants{.C1 = 2, .C2 = 0.25, .K = 0.5};
  const double L0 = latticeReferenceSize(fig6);
  EXPECT_NEAR(latticeSlope(constants, fig6, L0), 1, 1e-12);
  EXPECT_NEAR(latticeSlope(constants, fig6, 2 * L0), 0.875, 1e-12);
  EXPECT_NEAR(latticeSlope(constants, fig6.scaled(7), 7 * 2 * L0), 0.875, 1e-12)
      << "size over mean free path";
}

}  // namespace
}  // namespace lychnite
