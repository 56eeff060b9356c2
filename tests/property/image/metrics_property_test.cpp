#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lychnite/image/metrics.h"

namespace lychnite {
namespace {

Image noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0.05f, 1);
  Image image(width, height);
  for (size_t i = 0; i < image.pixelCount(); ++i)
    image.setRgb(i, {value(random), value(random), value(random)});
  return image;
}

Image scaled(const Image& image, float factor) {
  Image result = image;
  for (size_t i = 0; i < image.pixelCount(); ++i) result.setRgb(i, factor * image.rgb(i));
  return result;
}

Image mirrored(const Image& image) {
  Image result(image.width(), image.height());
  for (size_t i = 0; i < image.pixelCount(); ++i) result.setRgb(i, image.rgb(image.pixelCount() - 1 - i));
  return result;
}

class MetricsProperty : public testing::TestWithParam<unsigned> {
 protected:
  const Image a_ = noise(40, 24, GetParam()), b_ = noise(40, 24, GetParam() + 100);
};

TEST_P(MetricsProperty, BrightnessOfBothDoesNotMatter) {
  const Metrics plain = compare(a_, b_).together, bright = compare(scaled(a_, 8), scaled(b_, 8)).together;
  EXPECT_NEAR(bright.relative_rmse, plain.relative_rmse, 1e-12);
  EXPECT_NEAR(bright.bias, plain.bias, 1e-12);
  EXPECT_NEAR(bright.best_gain, plain.best_gain, 1e-12);
}

TEST_P(MetricsProperty, GainOfAIsFoundAndRemoved) {
  const Metrics plain = compare(a_, b_).together, bright = compare(scaled(a_, 4), b_).together;
  EXPECT_NEAR(bright.best_gain, plain.best_gain / 4, 1e-12);
  EXPECT_NEAR(bright.relative_rmse_after_gain, plain.relative_rmse_after_gain, 1e-9);
  EXPECT_LE(plain.relative_rmse_after_gain, plain.relative_rmse);
  EXPECT_NEAR(compare(scaled(b_, 0.5f), b_).together.relative_rmse_after_gain, 0, 1e-7);
}

TEST_P(MetricsProperty, ADifferenceOfBestGainIsWorse) {
  const double gain = compare(a_, b_).together.best_gain;
  const double best = compare(scaled(a_, float(gain)), b_).together.relative_rmse;
  for (const double other : {0.97, 1.03})
    EXPECT_GT(compare(scaled(a_, float(gain * other)), b_).together.relative_rmse, best);
}

TEST_P(MetricsProperty, WhereThePixelsLieDoesNotMatter) {
  const Comparison plain = compare(a_, b_), turned = compare(mirrored(a_), mirrored(b_));
  EXPECT_NEAR(turned.together.relative_rmse, plain.together.relative_rmse, 1e-12);
  EXPECT_NEAR(turned.together.psnr, plain.together.psnr, 1e-9);
  EXPECT_NEAR(turned.together.ssim, plain.together.ssim, 1e-5);
  EXPECT_NEAR(turned.flip, plain.flip, 1e-5);
}

TEST_P(MetricsProperty, DisplayMetricsAreSymmetricAndInRange) {
  const Comparison ab = compare(a_, b_), ba = compare(b_, a_);
  EXPECT_NEAR(ab.flip, ba.flip, 1e-9);
  EXPECT_NEAR(ab.together.ssim, ba.together.ssim, 1e-9);
  EXPECT_NEAR(ab.together.psnr, ba.together.psnr, 1e-9);
  for (const float value : flipMap(a_, b_)) {
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, MetricsProperty, testing::Values(1, 2, 3));

TEST(StandardErrorProperty, NoiseOfTheReferenceIsNotCountedAsError) {
  // A is 5 % from the truth at random; B is the truth with 20 % noise that it knows of. The estimate of the
  // mean square over 200 x 200 x 3 values has a standard deviation of about .04 sqrt(2 / 120000) = 1.7e-4
  // against .0025: 3.5 % of the root.
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  Image truth(200, 200), a(200, 200), b(200, 200);
  for (size_t i = 0; i < truth.pixelCount(); ++i) {
    truth.setRgb(i, glm::vec3(1));
    a.setRgb(i, glm::vec3(1) + 0.05f * glm::vec3(normal(random), normal(random), normal(random)));
    b.setRgb(i, glm::vec3(1) + 0.2f * glm::vec3(normal(random), normal(random), normal(random)));
    b.setRgb(i, glm::vec3(0.2f), "stderr");
  }
  const double exact = compare(a, truth).together.relative_rmse;
  const double seen = compare(a, b).together.relative_rmse;
  const double estimate = compare(a, b, {.exposure = 0, .useStandardError = true}).together.relative_rmse;
  EXPECT_NEAR(exact, 0.05, 0.001);
  EXPECT_NEAR(seen, std::hypot(0.05, 0.2), 0.002);
  EXPECT_NEAR(estimate, exact, 4 * 0.035 * exact);
}

}  // namespace
}  // namespace lychnite
