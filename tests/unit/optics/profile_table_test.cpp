#include <gtest/gtest.h>

#include <cmath>

#include "lychnite/base/error.h"
#include "lychnite/optics/materials.h"
#include "lychnite/optics/profile.h"

namespace lychnite {
namespace {

struct Worst {
  double peak = 0;      ///< |table - profile| over the profile's peak
  double relative = 0;  ///< the same over the profile's value, where it matters
  double tail = 0;      ///< of P, absolute (P(0) <= 1)
};

/// Over 1e-4 to 1e3 mean free paths. "Where it matters": a ring of one e-fold of r carries more than a
/// thousandth.
Worst worstOf(const Profile& profile, double unit, double mean_free_path, int channel) {
  const ProfileTable table(profile, unit);
  Worst worst;
  const double peak = profile.Rd(0)[channel];
  for (double x = 1e-4; x < 1e3; x *= 1.01) {
    const double r = x * mean_free_path, exact = profile.Rd(r)[channel];
    const double error = std::abs(double(table.Rd(r / unit)[channel]) / (unit * unit) - exact);
    worst.peak = std::max(worst.peak, error / peak);
    if (exact * 6.283 * r * r > 1e-3 * profile.P(0)[channel])
      worst.relative = std::max(worst.relative, error / exact);
    worst.tail = std::max(worst.tail, std::abs(double(table.P(r / unit)[channel]) - profile.P(r)[channel]));
  }
  return worst;
}

TEST(ProfileTable, FollowsTheDipole) {
  for (const char* name : {"marble", "skin1", "ketchup", "wholemilk", "fig6"}) {
    const Coefficients m = findMaterial(name, "").coefficients;
    const auto dipole = makeDipole(m);
    for (int c = 0; c < 3; ++c) {
      const Worst worst = worstOf(*dipole, 20, m.mean_free_path()[c], c);
      EXPECT_LT(worst.peak, 1e-4) << name << " " << c;
      // Measured: 0.005 in ketchup's and 0.0034 in skin1's red, whose core is many times the table's scale
      // (that of the shortest channel), so that the tail falls by a tenth from entry to entry; 0.001 in the
      // others.
      EXPECT_LT(worst.relative, 6e-3) << name << " " << c;
      EXPECT_LT(worst.tail, 2e-4) << name << " " << c;
    }
  }
}

TEST(ProfileTable, UnitsCancel) {
  const auto dipole = makeDipole(findMaterial("marble", "").coefficients);
  const ProfileTable mm(*dipole, 1), objects(*dipole, 50);
  EXPECT_NEAR(objects.scale() * 50, mm.scale(), 1e-12 * mm.scale());
  for (double r : {0.01, 0.5, 5.0, 40.0}) {
    EXPECT_NEAR(objects.Rd(r / 50).x / 2500, mm.Rd(r).x, 1e-5f * mm.Rd(r).x);
    EXPECT_NEAR(objects.P(r / 50).x, mm.P(r).x, 1e-6);
  }
}

TEST(ProfileTable, EndsAreHeld) {
  const auto dipole = makeDipole(findMaterial("marble", "").coefficients);
  const ProfileTable table(*dipole, 1, 64);
  EXPECT_EQ(table.size(), 64);
  EXPECT_EQ(table.Rd(0), table.RdTable().front());
  EXPECT_EQ(table.P(0), table.PTable().front());
  EXPECT_EQ(table.Rd(1e30), table.RdTable().back());
  EXPECT_GE(table.Rd(1e30).x, 0);
}

TEST(ProfileTable, EntriesLieAtTheTexelCentres) {
  const auto dipole = makeDipole(findMaterial("skin1", "").coefficients);
  const ProfileTable table(*dipole, 2, 256);
  for (int i : {0, 17, 128, 255}) {
    const double u = (i + 0.5) / 256, r = table.scale() * u / (1 - u);
    const auto k = size_t(i);
    EXPECT_FLOAT_EQ(table.RdTable()[k].y, float(dipole->Rd(2 * r).y * 4));
    EXPECT_NEAR(table.Rd(r).y, table.RdTable()[k].y, 1e-5f * table.RdTable()[k].y);
  }
}

TEST(ProfileTable, AMediumThatDoesNotScatterIsDarkEverywhere) {
  const ProfileTable table(*makeDipole(Coefficients{.sigma_a = Rgb(1)}), 1);
  EXPECT_EQ(table.Rd(0), glm::vec3(0));
  EXPECT_EQ(table.P(3), glm::vec3(0));
  EXPECT_GT(table.scale(), 0);
}

TEST(ProfileNames, RoundTripAndSuggest) {
  for (ProfileKind kind : {ProfileKind::kDipole, ProfileKind::kBetterDipole,
                           ProfileKind::kNormalizedDiffusion, ProfileKind::kTabulated})
    EXPECT_EQ(parseProfileKind(profileName(kind), ""), kind);
  try {
    parseProfileKind("dipol", "--profile");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::kUsage);
    EXPECT_EQ(error.parts().where, "--profile");
    EXPECT_NE(error.parts().todo.find("'dipole'"), std::string::npos);
  }
}

}  // namespace
}  // namespace lychnite
