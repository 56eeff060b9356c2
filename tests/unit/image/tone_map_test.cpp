#include "lychnite/image/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

using Curve = ToneMapping::Curve;

TEST(Srgb, KnownValues) {
  EXPECT_FLOAT_EQ(srgbFromLinear(0), 0);
  EXPECT_FLOAT_EQ(srgbFromLinear(1), 1);
  // Middle grey: 18 % of light is code 118 of 255.
  EXPECT_NEAR(srgbFromLinear(0.18f) * 255, 117.6, 0.1);
  EXPECT_NEAR(linearFromSrgb(0.5f), 0.21404, 1e-5);
  EXPECT_NEAR(srgbFromLinear(0.001f), 0.01292, 1e-7);
}

TEST(Srgb, TheTwoDirectionsUndoEachOther) {
  for (int code = 0; code <= 4096; ++code) {
    const float encoded = float(code) / 4096;
    EXPECT_NEAR(srgbFromLinear(linearFromSrgb(encoded)), encoded, 2e-7) << code;
  }
}

TEST(ToneMap, ExposureIsInStops) {
  const glm::vec3 shown = toneMap({0.1f, 0.2f, 0.3f}, {.curve = Curve::kSrgb, .exposure = 1});
  EXPECT_NEAR(shown.r, srgbFromLinear(0.2f), 1e-6);
  EXPECT_NEAR(shown.g, srgbFromLinear(0.4f), 1e-6);
  EXPECT_NEAR(shown.b, srgbFromLinear(0.6f), 1e-6);
}

TEST(ToneMap, SrgbClips) {
  EXPECT_EQ(toneMap({-1, 1.5f, 1e30f}, {}), glm::vec3(0, 1, 1));
}

TEST(ToneMap, FilmicFollowsHable) {
  const ToneMapping filmic{.curve = Curve::kFilmic, .exposure = 0};
  // f(x) = ((x (.15 x + .05) + .004) / (x (.15 x + .5) + .06)) - .02/.3 by hand: f(2) = .357430, f(11.2) =
  // .725149.
  EXPECT_NEAR(linearFromSrgb(toneMap(glm::vec3(1), filmic).r), 0.357430 / 0.725149, 2e-5);
  EXPECT_NEAR(toneMap(glm::vec3(0), filmic).r, 0, 1e-6);
  EXPECT_FLOAT_EQ(toneMap(glm::vec3(5.6f), filmic).r, 1);
  EXPECT_FLOAT_EQ(toneMap(glm::vec3(1e30f), filmic).r, 1);
}

TEST(ToneMap, EveryCurveRisesAndStaysInRange) {
  for (const Curve curve : {Curve::kSrgb, Curve::kFilmic}) {
    float previous = 0;
    for (float x = 0; x < 20; x += 0.01f) {
      const float shown = toneMap(glm::vec3(x), {.curve = curve, .exposure = 0}).g;
      EXPECT_GE(shown, previous) << x;
      EXPECT_LE(shown, 1) << x;
      previous = shown;
    }
  }
}

TEST(ToneMap, NanIsBlackAndInfinityWhite) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInfinity = std::numeric_limits<float>::infinity();
  for (const Curve curve : {Curve::kSrgb, Curve::kFilmic}) {
    const glm::vec3 shown = toneMap({kNan, kInfinity, -kInfinity}, {.curve = curve, .exposure = 0});
    EXPECT_NEAR(shown.r, 0, 1e-6);
    EXPECT_FLOAT_EQ(shown.g, 1);
    EXPECT_NEAR(shown.b, 0, 1e-6);
  }
}

TEST(ToneMap, NamesGoBothWays) {
  for (const Curve curve : {Curve::kSrgb, Curve::kFilmic})
    EXPECT_EQ(parseToneCurve(toneCurveName(curve), "--tone"), curve);
  try {
    parseToneCurve("reinhard", "--tone");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::kUsage);
    EXPECT_EQ(error.parts().where, "--tone");
    EXPECT_EQ(error.parts().found, "'reinhard'");
  }
}

}  // namespace
}  // namespace lychnite
