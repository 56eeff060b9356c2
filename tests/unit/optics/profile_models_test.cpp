#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lychnite/base/error.h"
#include "lychnite/optics/materials.h"
#include "lychnite/optics/profile.h"

namespace lychnite {
namespace {

Coefficients grey(double albedo, double eta) {
  return {.sigma_s = Rgb(albedo), .sigma_a = Rgb(1 - albedo), .g = 0, .eta = eta};
}

/// Integral of Rd 2 pi r dr over [a, b] with r = exp(t), composite Simpson.
double annulus(const Profile& profile, double a, double b, int channel) {
  constexpr int kSteps = 4000;
  const double t0 = std::log(a), h = (std::log(b) - t0) / kSteps;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double r = std::exp(t0 + i * h);
    const double weight = i == 0 || i == kSteps ? 1 : (i % 2 ? 4 : 2);
    sum += weight * profile.Rd(r)[channel] * 2 * std::numbers::pi * r * r;
  }
  return sum * h / 3;
}

class ProfileModels : public testing::TestWithParam<ProfileKind> {};

TEST_P(ProfileModels, TailIntegralIsTheIntegralOfRd) {
  for (const char* name : {"marble", "skin1", "ketchup", "spectralon"}) {
    const auto profile = makeProfile(GetParam(), findMaterial(name, "").coefficients);
    for (int c = 0; c < 3; ++c) {
      const double core = profile->coreLength()[c];
      for (double r : {0.1 * core, core, 10 * core}) {
        const double outer = 30 * r;
        const double expected = annulus(*profile, r, outer, c);
        EXPECT_NEAR(profile->P(r)[c] - profile->P(outer)[c], expected, 1e-4 * expected)
            << name << " " << c << " " << r;
      }
      // From the centre: what is left below 1e-6 cores is a disc of Rd(0).
      const double tiny = 1e-6 * core;
      const double inner = profile->Rd(0)[c] * std::numbers::pi * tiny * tiny;
      const double total = inner + annulus(*profile, tiny, 100 * core, c) + profile->P(100 * core)[c];
      EXPECT_NEAR(total, profile->P(0)[c], 1e-4 * profile->P(0)[c]) << name << " " << c;
    }
  }
}

TEST_P(ProfileModels, FallsMonotonicallyAndGivesBackLessThanItGets) {
  for (const NamedCoefficients& material : materialLibrary()) {
    const auto profile = makeProfile(GetParam(), material.coefficients);
    EXPECT_TRUE(std::isfinite(profile->Rd(0).x));
    for (int c = 0; c < 3; ++c) {
      EXPECT_LE(profile->P(0)[c], 1.0) << material.name;
      double lastP = profile->P(0)[c], lastRd = profile->Rd(0)[c];
      for (double r = 1e-5 * profile->coreLength()[c]; r < 50 * profile->coreLength()[c]; r *= 1.3) {
        EXPECT_GT(lastP, profile->P(r)[c]) << material.name << " at " << r;
        EXPECT_GE(lastRd, profile->Rd(r)[c]) << material.name << " at " << r;
        lastP = profile->P(r)[c];
        lastRd = profile->Rd(r)[c];
      }
    }
  }
}

TEST_P(ProfileModels, ScalesWithTheWorld) {
  const Coefficients m = findMaterial("skin2", "").coefficients;
  const auto one = makeProfile(GetParam(), m), ten = makeProfile(GetParam(), m.scaled(10));
  for (double r : {0.0, 0.1, 1.0, 5.0})
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(ten->Rd(10 * r)[c] * 100, one->Rd(r)[c], 1e-9 * one->Rd(r)[c]);
      EXPECT_NEAR(ten->P(10 * r)[c], one->P(r)[c], 1e-12);
    }
}

TEST_P(ProfileModels, EmptyChannelsAreDark) {
  const auto profile =
      makeProfile(GetParam(), {.sigma_s = {0, 1, 0}, .sigma_a = {0, 0, 2}, .g = 0, .eta = 1.4});
  EXPECT_EQ(profile->Rd(0.5).x, 0);
  EXPECT_EQ(profile->P(0).z, 0);
  EXPECT_GT(profile->P(0).y, 0);
  EXPECT_EQ(profile->coreLength().x, 0);
}

INSTANTIATE_TEST_SUITE_P(Profiles, ProfileModels,
                         testing::Values(ProfileKind::kDipole, ProfileKind::kBetterDipole,
                                         ProfileKind::kNormalizedDiffusion),
                         [](const auto& model) {
                           return std::string(model.param == ProfileKind::kDipole ? "Dipole"
                                              : model.param == ProfileKind::kBetterDipole
                                                  ? "BetterDipole"
                                                  : "NormalizedDiffusion");
                         });

TEST(BetterDipole, TotalIsTheClosedFormOfTheIndexMatchedCase) {
  // Hery & Villemin's albedo inversion of the better dipole with C1 = C2 = 0: C_phi = 1/4, C_E = 1/2, A = 1.
  for (double albedo : {0.5, 0.9, 0.999}) {
    const double decay = std::sqrt((1 - albedo) * (2 - albedo) / 3);
    const double mirror = std::exp(-4 * decay);
    const double expected = 0.5 * albedo * albedo * std::exp(-std::sqrt(3 * (1 - albedo) / (2 - albedo))) *
                            (0.5 * (1 + mirror) + 0.25 / decay * (1 - mirror));
    EXPECT_NEAR(makeBetterDipole(grey(albedo, 1))->P(0).x, expected, 1e-12);
  }
}

TEST(BetterDipole, NothingAbsorbedAllComesBack) {
  for (double eta : {1.0, 1.3, 1.5}) EXPECT_NEAR(makeBetterDipole(grey(1, eta))->P(0).x, 1.0, 2e-3) << eta;
}

TEST(NormalizedDiffusion, TotalIsTheExactAlbedoWhenIndexMatched) {
  // Chandrasekhar's diffuse albedos (docs/physics.md, "Known answers"); van de Hulst's fit is within 0.0025.
  const double table[][2] = {{0.5, 0.146544},  {0.8, 0.341867},  {0.9, 0.478024},
                             {0.95, 0.596669}, {0.99, 0.794564}, {0.999, 0.929713}};
  for (const auto& [albedo, exact] : table)
    EXPECT_NEAR(makeNormalizedDiffusion(grey(albedo, 1))->P(0).x, exact, 0.0025) << albedo;
}

TEST(NormalizedDiffusion, InvertsTheColourRelation) {
  for (double colour : {0.2, 0.5, 0.9}) {
    const Coefficients m = coefficientsFromColour(Rgb(colour), Rgb(1), 0, 1);
    EXPECT_NEAR(makeNormalizedDiffusion(m)->P(0).x, colour, 1e-3);
  }
}

TEST(NormalizedDiffusion, ShapeIsAsPublished) {
  // s = 1.9 - A + 3.5 (A - 0.8)^2 at the albedo that gives A = 0.5; the value of R(r) by hand.
  const Coefficients m = coefficientsFromColour(Rgb(0.5), Rgb(2), 0, 1);
  const double A = 0.5, l = 2, s = 1.9 - A + 3.5 * (A - 0.8) * (A - 0.8), r = 1.5;
  const double expected =
      A * s * (std::exp(-s * r / l) + std::exp(-s * r / (3 * l))) / (8 * std::numbers::pi * l * r);
  EXPECT_NEAR(makeNormalizedDiffusion(m)->Rd(r).x, expected, 2e-3 * expected);
}

TEST(MakeProfile, TabulatedNeedsAMaker) {
  const Coefficients m{.sigma_s = Rgb(1), .sigma_a = Rgb(1), .g = 0, .eta = 1.4};
  EXPECT_THROW(makeProfile({}, {ProfileKind::kTabulated, m, ProfileOrders::kAll}), Error);
  const ProfileMaker maker = [](const ProfileRequest& request, const Progress&) {
    return makeDipole(request.medium);
  };
  EXPECT_EQ(makeProfile(maker, {ProfileKind::kTabulated, m, ProfileOrders::kAll})->P(0), makeDipole(m)->P(0));
}

}  // namespace
}  // namespace lychnite
