#include <gtest/gtest.h>

#include <cmath>

#include "lychnite/optics/profile.h"
#include "property/random.h"

namespace lychnite {
namespace {

std::string shown(const Coefficients& m) {
  std::string text = "g " + std::to_string(m.g) + " eta " + std::to_string(m.eta);
  for (int c = 0; c < 3; ++c)
    text += " | " + std::to_string(m.sigma_s[c]) + " " + std::to_string(m.sigma_a[c]);
  return text;
}

class ProfileProperties : public testing::TestWithParam<ProfileKind> {};

TEST_P(ProfileProperties, EnergyIsKeptAndTheTailFalls) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Coefficients m = random.medium();
    const auto profile = makeProfile(GetParam(), m);
    for (int c = 0; c < 3; ++c) {
      const double length = 1 / (m.sigma_tp()[c] + 1e-9);
      double last = profile->P(0)[c];
      // The better dipole's clear half-space gives back up to 0.2 % too much: its exitance is an
      // approximation.
      ASSERT_LE(last, 1.002) << shown(m);
      for (double x = 1e-3; x < 100; x *= 1.7) {
        const double P = profile->P(x * length)[c], Rd = profile->Rd(x * length)[c];
        ASSERT_TRUE(std::isfinite(P) && std::isfinite(Rd)) << shown(m);
        ASSERT_GE(P, -1e-15) << shown(m);
        ASSERT_GE(Rd, 0) << shown(m);
        ASSERT_LE(P, last * (1 + 1e-12)) << shown(m);
        last = P;
      }
    }
  }
}

TEST_P(ProfileProperties, ARingHoldsWhatRdSays) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Coefficients m = random.medium();
    const auto profile = makeProfile(GetParam(), m);
    const int c = i % 3;
    const double a = random.logUniform(0.01, 10) / (m.sigma_tp()[c] + 1e-9), b = 1.01 * a;
    const double ring = 3.14159265358979 * (b * b - a * a);
    const double mean = (profile->Rd(a) + 4.0 * profile->Rd(0.5 * (a + b)) + profile->Rd(b))[c] / 6;
    // The difference of two tails loses digits where the ring is a small part of them.
    EXPECT_NEAR(profile->P(a)[c] - profile->P(b)[c], ring * mean, 1e-3 * ring * mean + 1e-12) << shown(m);
  }
}

TEST_P(ProfileProperties, ScalingTheWorldScalesNothingElse) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Coefficients m = random.medium();
    const double s = random.logUniform(1e-3, 1e3);
    const auto one = makeProfile(GetParam(), m), other = makeProfile(GetParam(), m.scaled(s));
    for (double x : {0.0, 0.1, 1.0, 10.0})
      for (int c = 0; c < 3; ++c) {
        const double r = x / (m.sigma_tp()[c] + 1e-9), Rd = one->Rd(r)[c];
        ASSERT_NEAR(other->Rd(s * r)[c] * s * s, Rd, 1e-8 * Rd + 1e-300) << shown(m);
        ASSERT_NEAR(other->P(s * r)[c], one->P(r)[c], 1e-9) << shown(m);
      }
  }
}

TEST_P(ProfileProperties, AbsorptionDarkens) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    Coefficients m = random.medium();
    const Rgb before = makeProfile(GetParam(), m)->P(0);
    m.sigma_a = m.sigma_a * 1.5 + 1e-4;
    const Rgb after = makeProfile(GetParam(), m)->P(0);
    for (int c = 0; c < 3; ++c) ASSERT_LE(after[c], before[c]) << shown(m);
  }
}

TEST_P(ProfileProperties, TablesKeepTheTotal) {
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    const Coefficients m = random.medium();
    const auto profile = makeProfile(GetParam(), m);
    const ProfileTable table(*profile, random.logUniform(1e-3, 1e3));
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(table.P(0)[c], profile->P(0)[c], 2e-3) << shown(m);
      for (const glm::vec3& entry : table.RdTable())
        ASSERT_TRUE(std::isfinite(entry[c]) && entry[c] >= 0) << shown(m);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, ProfileProperties,
                         testing::Values(ProfileKind::kDipole, ProfileKind::kBetterDipole,
                                         ProfileKind::kNormalizedDiffusion));

}  // namespace
}  // namespace lychnite
