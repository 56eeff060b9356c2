#include "accuracy/score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lychnite::accuracy {
namespace {

/// `signal` with independent normal noise.
Values noisy(const Values& signal, float deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0, deviation);
  Values values = signal;
  for (glm::vec3& v : values) v += glm::vec3(normal(random), normal(random), normal(random));
  return values;
}

Values plain(size_t points, float value) {
  return Values(points, glm::vec3(value));
}

TEST(AccuracyScore, IsExactWithoutNoise) {
  Values model = plain(100, 2);
  for (size_t i = 0; i < model.size(); ++i) model[i] *= i % 2 ? 1.1f : 0.96f;
  const Score score = scoreOf({model, model}, {plain(100, 2), plain(100, 2)});
  EXPECT_NEAR(score.rmse, std::sqrt((0.1 * 0.1 + 0.04 * 0.04) / 2), 1e-6);
  EXPECT_NEAR(score.quiet, score.rmse, 1e-9);
  EXPECT_NEAR(score.bias, 0.03, 1e-6);
  EXPECT_EQ(score.error, 0);
}

TEST(AccuracyScore, LeavesOutTheTruthsNoiseAndTellsTheModels) {
  constexpr size_t kPoints = 20000;
  const Values truth = plain(kPoints, 1), model = plain(kPoints, 1.05f);
  const Halves walks{noisy(truth, 0.2f, 1), noisy(truth, 0.2f, 2)};
  const Score quiet = scoreOf({model, model}, walks);
  EXPECT_NEAR(quiet.rmse, 0.05, 4 * quiet.error);
  EXPECT_LT(quiet.error, 0.005);
  const Score loud = scoreOf({noisy(model, 0.1f, 3), noisy(model, 0.1f, 4)}, walks);
  EXPECT_NEAR(loud.rmse, std::hypot(0.05, 0.1), 4 * loud.error);
  EXPECT_NEAR(loud.quiet, 0.05, 0.01);
}

TEST(AccuracyScore, ErrorIsWhatScoresVaryBy) {
  constexpr int kRuns = 60;
  const Values truth = plain(300, 1), model = plain(300, 1.2f);
  double sum = 0, squares = 0, told = 0;
  for (unsigned i = 0; i < kRuns; ++i) {
    // As photons' noise is, alike in all channels.
    Halves walks{truth, truth};
    for (unsigned half : {0u, 1u}) {
      const Values noise = noisy(plain(300, 0), 0.3f, 10 + 2 * i + half);
      for (size_t p = 0; p < 300; ++p) walks[half][p] += glm::vec3(noise[p].x);
    }
    const Score score = scoreOf({model, model}, walks);
    sum += score.rmse;
    squares += score.rmse * score.rmse;
    told += score.error / kRuns;
  }
  const double deviation = std::sqrt((squares - sum * sum / kRuns) / (kRuns - 1));
  EXPECT_NEAR(told / deviation, 1, 0.35);  // 60 runs tell a deviation to 9 %; the mean's own noise is in it
}

TEST(AccuracyScore, SaysHowLargeAnErrorMayBeThatNoiseHides) {
  const Values truth = plain(1000, 1);
  int hidden = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Score score =
        scoreOf({truth, truth}, {noisy(truth, 0.3f, 100 + seed), noisy(truth, 0.3f, 200 + seed)});
    EXPECT_LT(score.rmse, 3 * score.error);
    EXPECT_LT(score.error, 0.1);
    hidden += score.rmse == 0;
  }
  EXPECT_GT(hidden, 0);  // negative estimates
}

TEST(AccuracyScore, MeansAreOverNeighbours) {
  const Values values{glm::vec3(1), glm::vec3(3), glm::vec3(5), glm::vec3(9)};
  EXPECT_EQ(means(values, 2), (Values{glm::vec3(2), glm::vec3(7)}));
}

}  // namespace
}  // namespace lychnite::accuracy
