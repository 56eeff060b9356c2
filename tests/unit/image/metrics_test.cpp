#include "lychnite/image/metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lychnite/base/error.h"
#include "lychnite/image/tone_map.h"

namespace lychnite {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A 2 x 2 picture with the same values in every channel.
Image grey(const std::array<float, 4>& values) {
  Image image(2, 2);
  for (size_t i = 0; i < 4; ++i) image.setRgb(i, glm::vec3(values[i]));
  return image;
}

/// The pictures whose FLIP the reference implementation was asked for: B a coloured saw-tooth, A darker by a
/// tenth and with a negative in one corner, both given as sRGB values.
std::array<Image, 2> pattern() {
  std::array<Image, 2> pair{Image(48, 32), Image(48, 32)};
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 48; ++x) {
      glm::vec3 a, b;
      for (int c = 0; c < 3; ++c) {
        const float base = float((x * (c + 1) + 2 * y) % 64) / 63;
        b[c] = linearFromSrgb(base);
        a[c] = linearFromSrgb(x >= 24 && y < 20 ? 1 - base : 0.9f * base);
      }
      pair[0].setRgb(size_t(y * 48 + x), a);
      pair[1].setRgb(size_t(y * 48 + x), b);
    }
  return pair;
}

std::string refusalOf(const Image& a, const Image& b, const CompareOptions& options = {}) {
  try {
    compare(a, b, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Compare, EqualPicturesHaveNoError) {
  const Image picture = pattern()[1];
  const Comparison same = compare(picture, picture);
  EXPECT_EQ(same.together.relative_rmse, 0);
  EXPECT_EQ(same.together.bias, 0);
  EXPECT_DOUBLE_EQ(same.together.best_gain, 1);
  EXPECT_LT(same.together.relative_rmse_after_gain, 1e-12);
  EXPECT_EQ(same.together.psnr, std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(same.together.ssim, 1);
  EXPECT_DOUBLE_EQ(same.channels[2].ssim, 1);
  EXPECT_EQ(same.flip, 0);
  EXPECT_EQ(same.pixels, 48u * 32u);
}

TEST(Compare, ValuesByHand) {
  // mean of B 2, mean square (1 + 0 + 0 + 1) / 4; gain sum ab / sum aa = 17 / 18; after it (18 - 17^2 / 18)
  // / 4.
  const Comparison result = compare(grey({2, 2, 3, 1}), grey({1, 2, 3, 2}));
  for (const Metrics& metrics :
       {result.together, result.channels[0], result.channels[1], result.channels[2]}) {
    EXPECT_NEAR(metrics.relative_rmse, std::sqrt(0.5) / 2, 1e-12);
    EXPECT_NEAR(metrics.bias, 0, 1e-12);
    EXPECT_NEAR(metrics.best_gain, 17. / 18, 1e-12);
    EXPECT_NEAR(metrics.relative_rmse_after_gain, std::sqrt((18 - 289. / 18) / 4) / 2, 1e-12);
  }
}

TEST(Compare, BiasHasTheSignOfTheExcess) {
  const Comparison result = compare(grey({2, 3, 3, 4}), grey({1, 2, 3, 2}));
  EXPECT_NEAR(result.together.bias, 0.5, 1e-12);
}

TEST(Compare, ChannelsArePooledWithOneGain) {
  Image a(1, 1), b(1, 1);
  a.setRgb(0, {1, 1, 2});
  b.setRgb(0, {1, 2, 3});
  const Comparison result = compare(a, b);
  // Mean of B 2, mean square (0 + 1 + 1) / 3, gain (1 + 2 + 6) / (1 + 1 + 4).
  EXPECT_NEAR(result.together.relative_rmse, std::sqrt(2. / 3) / 2, 1e-12);
  EXPECT_NEAR(result.together.bias, -1. / 3, 1e-12);
  EXPECT_NEAR(result.together.best_gain, 1.5, 1e-12);
  EXPECT_NEAR(result.channels[1].relative_rmse, 0.5, 1e-12);
  EXPECT_NEAR(result.channels[1].best_gain, 2, 1e-12);
  EXPECT_NEAR(result.channels[1].relative_rmse_after_gain, 0, 1e-12);
}

TEST(Compare, AlphaOfBWeighs) {
  Image b = grey({1, 2, 3, 100});
  b.addChannel("A") = {1, 0.5f, 0.5f, 0};
  const Comparison result = compare(grey({2, 2, 4, 0}), b);
  // Weights 1, 1/2, 1/2, 0: mean of B 3.5 / 2, mean square (1 + 0 + 0.5) / 2.
  EXPECT_NEAR(result.together.relative_rmse, std::sqrt(0.75) / 1.75, 1e-12);
  EXPECT_NEAR(result.together.bias, (5 - 3.5) / 3.5, 1e-12);
  EXPECT_EQ(result.pixels, 3u);
}

TEST(Compare, ABlackChannelIsMeasuredAgainstAllThree) {
  Image a(1, 1), b(1, 1);
  a.setRgb(0, {3, 1, 0});
  b.setRgb(0, {3, 0, 0});
  const Comparison result = compare(a, b);
  EXPECT_NEAR(result.channels[1].relative_rmse, 1, 1e-12);
  EXPECT_NEAR(result.channels[1].bias, 1, 1e-12);
  EXPECT_EQ(result.channels[2].best_gain, 1);
}

TEST(Compare, PsnrOfAKnownStep) {
  Image a(4, 4), b(4, 4);
  for (size_t i = 0; i < 16; ++i) {
    a.setRgb(i, glm::vec3(linearFromSrgb(0.6f)));
    b.setRgb(i, {linearFromSrgb(0.5f), linearFromSrgb(0.6f), linearFromSrgb(0.6f)});
  }
  const Comparison result = compare(a, b);
  EXPECT_NEAR(result.channels[0].psnr, 20, 1e-4);
  EXPECT_NEAR(result.together.psnr, 20 + 10 * std::log10(3), 1e-4);
}

TEST(Compare, SsimOfFlatPicturesIsTheLuminanceTerm) {
  Image a(20, 20), b(20, 20);
  for (size_t i = 0; i < 400; ++i) {
    a.setRgb(i, glm::vec3(linearFromSrgb(0.5f)));
    b.setRgb(i, glm::vec3(linearFromSrgb(0.25f)));
  }
  // (2 * .5 * .25 + C1) / (.25 + .0625 + C1), C1 = 1e-4; no contrast, so the other terms are 1.
  const double expected = (0.25 + 1e-4) / (0.3125 + 1e-4);
  const Comparison result = compare(a, b);
  EXPECT_NEAR(result.together.ssim, expected, 1e-4);
  EXPECT_NEAR(result.channels[1].ssim, expected, 1e-4);
}

TEST(Compare, SsimOfANegativeIsNegative) {
  Image a(32, 32), b(32, 32);
  for (size_t i = 0; i < 1024; ++i) {
    const float value = (i + i / 32) % 2 ? 0.8f : 0.2f;
    a.setRgb(i, glm::vec3(linearFromSrgb(value)));
    b.setRgb(i, glm::vec3(linearFromSrgb(1 - value)));
  }
  // A checkerboard of amplitude .3 about .5 against its negative: variances .09, covariance -.09, equal
  // means.
  EXPECT_NEAR(compare(a, b).together.ssim, (-0.18 + 9e-4) / (0.18 + 9e-4), 1e-3);
}

TEST(Compare, ExposureMovesOnlyWhatADisplayShows) {
  const auto [a, b] = pattern();
  const Comparison normal = compare(a, b), dark = compare(a, b, {.exposure = -3, .useStandardError = false});
  EXPECT_EQ(normal.together.relative_rmse, dark.together.relative_rmse);
  EXPECT_EQ(normal.together.best_gain, dark.together.best_gain);
  EXPECT_GT(dark.together.psnr, normal.together.psnr + 3);
  EXPECT_LT(dark.flip, normal.flip);
}

TEST(Flip, AgreesWithTheAuthorsProgram) {
  // The value of the authors' C++ implementation (FLIP.h of github.com/NVlabs/flip, default 67.02 pixels per
  // degree) for the same two pictures; the difference of the two programs was below 2e-6 in every pixel.
  const auto [a, b] = pattern();
  EXPECT_NEAR(compare(a, b).flip, 0.5456022, 2e-5);
}

TEST(Flip, GreenAgainstBlueIsTheLargest) {
  Image green(16, 16), blue(16, 16);
  for (size_t i = 0; i < 256; ++i) {
    green.setRgb(i, {0, 1, 0});
    blue.setRgb(i, {0, 0, 1});
  }
  for (const float value : flipMap(green, blue)) EXPECT_NEAR(value, 1, 1e-6);
}

TEST(Flip, WorksOnPicturesSmallerThanItsFilters) {
  Image a(3, 2), b(3, 2);
  for (size_t i = 0; i < 6; ++i) {
    a.setRgb(i, {0, 0, 0});
    b.setRgb(i, {1, i == 1 ? linearFromSrgb(0.2f) : 1, 1});
  }
  // Also from the authors' program.
  EXPECT_NEAR(compare(a, b).flip, 0.9770802, 1e-5);
}

TEST(Compare, RefusesWhatCannotBeCompared) {
  const Image good = grey({1, 2, 3, 4});
  EXPECT_THAT(refusalOf(Image(3, 2), good), AllOf(HasSubstr("3 x 2"), HasSubstr("2 x 2")));
  EXPECT_THAT(refusalOf(Image(), Image()), HasSubstr("0 x 0"));
  Image depth(2, 2);
  depth.addChannel("depth.Z");
  EXPECT_THAT(refusalOf(depth, good), AllOf(HasSubstr("picture A"), HasSubstr("depth.Z")));
  EXPECT_THAT(refusalOf(good, depth), HasSubstr("picture B"));
  EXPECT_THAT(refusalOf(good, grey({0, 0, 0, 0})), HasSubstr("not black"));
  Image uncovered = good;
  uncovered.addChannel("A");
  EXPECT_THAT(refusalOf(good, uncovered), HasSubstr("alpha 0 everywhere"));
  EXPECT_EQ(refusalOf(uncovered, good), "no error") << "only B's alpha counts";
}

TEST(Compare, NamesTheFirstPixelThatIsNotFinite) {
  const Image good = grey({1, 2, 3, 4});
  Image bad = good;
  bad.addChannel("G")[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(refusalOf(bad, good),
              AllOf(HasSubstr("picture A"), HasSubstr("nan at pixel (1, 1) of channel G")));
  bad.addChannel("G")[2] = -std::numeric_limits<float>::infinity();
  EXPECT_THAT(refusalOf(good, bad),
              AllOf(HasSubstr("picture B"), HasSubstr("-inf at pixel (0, 1) of channel G")));
  EXPECT_THROW(flipMap(good, bad), Error);
  EXPECT_THROW(errorMap(good, bad), Error);
}

TEST(Compare, StandardErrorIsTakenOut) {
  Image b = grey({1, 2, 3, 2});
  for (size_t i = 0; i < 4; ++i) b.setRgb(i, glm::vec3(0.5f), "stderr");
  const CompareOptions useIt{.exposure = 0, .useStandardError = true};
  const Image a = grey({2, 2, 3, 1});
  // Mean square 0.5 less the variance 0.25.
  EXPECT_NEAR(compare(a, b, useIt).together.relative_rmse, 0.5 / 2, 1e-12);
  EXPECT_NEAR(compare(a, b).together.relative_rmse, std::sqrt(0.5) / 2, 1e-12);
  EXPECT_NEAR(compare(a, b, useIt).together.bias, compare(a, b).together.bias, 1e-15);
  EXPECT_EQ(compare(b, b, useIt).together.relative_rmse, 0) << "below the noise";
  EXPECT_THAT(refusalOf(b, a, useIt), AllOf(HasSubstr("picture B"), HasSubstr("stderr.R")));
  b.addChannel("stderr.B")[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(refusalOf(a, b, useIt), HasSubstr("pixel (1, 0) of channel stderr.B"));
}

TEST(ErrorMap, GetsLighterWithTheErrorAndGreyOutside) {
  Image b(5, 1), a(5, 1);
  b.addChannel("A") = {1, 1, 1, 1, 0};
  for (size_t i = 0; i < 5; ++i) {
    b.setRgb(i, glm::vec3(1));
    a.setRgb(i, glm::vec3(1 + 0.2f * float(i)));
  }
  const Image map = errorMap(a, b, 0.4);
  const auto lightness = [&](size_t i) { return glm::vec3(0.2126f, 0.7152f, 0.0722f) * map.rgb(i); };
  const auto sum = [](const glm::vec3& v) { return v.r + v.g + v.b; };
  EXPECT_LT(sum(lightness(0)), 0.001);
  EXPECT_LT(sum(lightness(0)), sum(lightness(1)));
  EXPECT_LT(sum(lightness(1)), sum(lightness(2)));
  // 0.4 and 0.6 are at and beyond the end of the scale.
  EXPECT_GT(sum(lightness(2)), 0.9);
  EXPECT_NEAR(sum(lightness(2)), sum(lightness(3)), 1e-5);
  EXPECT_EQ(map.rgb(4).r, map.rgb(4).g);
  EXPECT_NEAR(srgbFromLinear(map.rgb(4).b), 0.25, 1e-5);
}

}  // namespace
}  // namespace lychnite
