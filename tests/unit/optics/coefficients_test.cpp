#include "lychnite/optics/coefficients.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const Coefficients kMedium{.sigma_s = {4, 2, 1}, .sigma_a = {1, 0, 3}, .g = 0.5, .eta = 1.4};

void expectRgb(const Rgb& value, const Rgb& expected) {
  for (int c = 0; c < 3; ++c) EXPECT_DOUBLE_EQ(value[c], expected[c]) << "channel " << c;
}

TEST(Coefficients, DerivedValues) {
  expectRgb(kMedium.sigma_t(), {5, 2, 4});
  expectRgb(kMedium.sigma_sp(), {2, 1, 0.5});
  expectRgb(kMedium.sigma_tp(), {3, 1, 3.5});
  expectRgb(kMedium.albedo(), {0.8, 1, 0.25});
  expectRgb(kMedium.albedo_p(), {2.0 / 3, 1, 0.5 / 3.5});
  expectRgb(kMedium.sigma_tr(), {3, 0, std::sqrt(31.5)});
  expectRgb(kMedium.mean_free_path(), {0.2, 0.5, 0.25});
}

TEST(Coefficients, AnEmptyMediumHasNoAlbedoAndNoEnd) {
  const Coefficients empty;
  expectRgb(empty.albedo(), Rgb(0));
  expectRgb(empty.albedo_p(), Rgb(0));
  expectRgb(empty.sigma_tr(), Rgb(0));
  expectRgb(empty.mean_free_path(), Rgb(kInfinity));
}

TEST(Coefficients, ScalingTheWorldKeepsProportions) {
  const Coefficients ten = kMedium.scaled(10);
  expectRgb(ten.mean_free_path(), kMedium.mean_free_path() * 10.0);
  expectRgb(ten.albedo_p(), kMedium.albedo_p());
  EXPECT_EQ(ten.g, kMedium.g);
  EXPECT_EQ(ten.eta, kMedium.eta);
}

TEST(ValidateCoefficients, TakesWhatIsPhysical) {
  EXPECT_NO_THROW(validate(kMedium, "medium"));
  EXPECT_NO_THROW(validate(Coefficients{.eta = 1}, ""));
  EXPECT_NO_THROW(validate({.sigma_s = Rgb(1e6), .sigma_a = Rgb(0), .g = -0.99, .eta = 4}, ""));
}

TEST(ValidateCoefficients, NamesWhatIsNot) {
  struct Case {
    const char* name;
    Coefficients medium;
  };
  const Case cases[]{
      {"sigma_s", {.sigma_s = {1, -1e-9, 1}}},
      {"sigma_s", {.sigma_s = {1, 1, kNan}}},
      {"sigma_a", {.sigma_a = {-1, 0, 0}}},
      {"sigma_a", {.sigma_a = {0, kInfinity, 0}}},
      {"g", {.g = 1}},
      {"g", {.g = -1}},
      {"g", {.g = kNan}},
      {"eta", {.eta = 0.99}},
      {"eta", {.eta = 4.01}},
      {"eta", {.eta = kNan}},
  };
  for (const Case& each : cases) {
    try {
      validate(each.medium, "object 'bust'");
      ADD_FAILURE() << each.name << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.parts().where, std::string("object 'bust': ") + each.name);
      EXPECT_EQ(error.kind(), Error::Kind::kUsage);
      EXPECT_FALSE(error.parts().expected.empty());
    }
  }
}

TEST(ValidateCoefficients, SaysWhichWayRoundTheIndexIs) {
  try {
    validate(Coefficients{.eta = 0.75}, "");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.parts().where, "eta");
    EXPECT_NE(error.parts().expected.find("inside over outside"), std::string::npos);
    EXPECT_EQ(error.parts().found, "0.75");
  }
}

TEST(AlbedoFromColour, KnownPoints) {
  const Rgb alpha = albedoFromColour({0.5, 0.9, 0}, 0);
  EXPECT_NEAR(alpha.x, 0.9117, 5e-5);
  EXPECT_NEAR(alpha.y, 0.99791, 5e-6);
  EXPECT_NEAR(alpha.z, 0, 1e-5);
}

TEST(AlbedoFromColour, StaysBelowOneAndRises) {
  double last = -1;
  for (double a = 0; a < 1; a += 0.01) {
    const double alpha = albedoFromColour(Rgb(a), 0.3).x;
    EXPECT_GT(alpha, last) << a;
    EXPECT_LE(alpha, 1) << a;
    last = alpha;
  }
}

TEST(AlbedoFromColour, AsymmetryKeepsTheReducedAlbedo) {
  for (double g : {-0.5, 0.3, 0.9}) {
    const double alpha = albedoFromColour(Rgb(0.7), g).x;
    EXPECT_NEAR(alpha * (1 - g) / (1 - alpha * g), albedoFromColour(Rgb(0.7), 0).x, 1e-12) << g;
  }
}

TEST(CoefficientsFromColour, HaveTheAlbedoAndTheMeanFreePath) {
  const Coefficients m = coefficientsFromColour({0.2, 0.5, 0.8}, {1, 2, 4}, 0.25, 1.4);
  const Rgb alpha = albedoFromColour({0.2, 0.5, 0.8}, 0.25);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(m.albedo()[c], alpha[c], 1e-14);
    EXPECT_NEAR(m.mean_free_path()[c], std::exp2(c), 1e-12);
  }
  EXPECT_EQ(m.g, 0.25);
  EXPECT_EQ(m.eta, 1.4);
}

}  // namespace
}  // namespace lychnite
