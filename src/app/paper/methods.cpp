#include "app/paper/methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "lychnite/image/metrics.h"

namespace lychnite::paper {

std::vector<MethodColumn> comparedMethods() {
  return {{.name = "fixed", .label = "fixed", .method = Method::kFixed, .style = 5, .inStrip = false},
          {.name = "adaptive", .label = "adaptive", .method = Method::kAdaptive, .style = 1},
          {.name = "matched", .label = "matched", .method = Method::kMatched, .style = 2},
          {.name = "volume", .label = "volume", .method = Method::kVolume, .style = 3},
          {.name = "hierarchical",
           .label = "hierarchical",
           .method = Method::kHierarchical,
           .style = 4,
           .inStrip = false}};
}

Truth truthOf(Studio& studio, const std::string& name, const Scene& scene, const RenderSettings& settings) {
  RenderSettings half = settings;
  half.noise = settings.noise * std::sqrt(2.0);
  half.timeLimit = settings.timeLimit / 2;
  Truth truth;
  truth.first = studio.picture(name + "-first", scene, half);
  half.seed = settings.seed + 1;
  truth.second = studio.picture(name + "-second", scene, half);
  truth.mean = truth.first;
  double squares = 0, sum = 0, covered = 0;
  for (size_t i = 0; i < truth.mean.pixelCount(); ++i) {
    const glm::vec3 a = truth.first.rgb(i), b = truth.second.rgb(i);
    truth.mean.setRgb(i, 0.5f * (a + b));
    if (truth.mean.channel("A")[i] < 1) continue;
    squares += double(glm::dot(a - b, a - b)) / 4;
    sum += double(a.x + a.y + a.z + b.x + b.y + b.z) / 2;
    covered += 3;
  }
  truth.noise = sum > 0 ? std::sqrt(squares * covered) / sum : 0;
  truth.seconds = Studio::secondsOf(truth.first) + Studio::secondsOf(truth.second);
  return truth;
}

namespace {

/// Sums over the method's values m and the truths a, b of all covered pixels and channels.
struct Sums {
  double m = 0, truth = 0, mm = 0, mt = 0, ab = 0, count = 0;
  double variance = 0;  ///< of the sum of (m - a)(m - b), by the halves' own difference
};

Sums sumsOf(const Image& image, const Truth& truth) {
  Sums sums;
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    if (truth.first.channel("A")[i] < 1) continue;
    double deviation = 0;
    for (int c = 0; c < 3; ++c) {
      const double m = double(image.rgb(i)[c]);
      const double a = double(truth.first.rgb(i)[c]), b = double(truth.second.rgb(i)[c]);
      sums.m += m;
      sums.truth += 0.5 * (a + b);
      sums.mm += m * m;
      sums.mt += 0.5 * m * (a + b);
      sums.ab += a * b;
      const double noise = (a - b) * (a - b);
      deviation += std::sqrt(std::max((m - a) * (m - b), 0.0) * noise + noise * noise / 12);
    }
    sums.variance += deviation * deviation;  // the channels share their photons
    sums.count += 3;
  }
  return sums;
}

}  // namespace

Score scoreOf(const Image& image, const Truth& truth, double exposure) {
  const Sums s = sumsOf(image, truth);
  const double mean = s.truth / std::max(s.count, 1.0);
  const auto rmse = [&](double gain) {
    return std::sqrt(std::max(0.0, (gain * gain * s.mm - 2 * gain * s.mt + s.ab) / s.count)) / mean;
  };
  Score score{.rmse = rmse(1), .bias = s.m / s.truth - 1, .gain = s.mm > 0 ? s.mt / s.mm : 1};
  // Where the square is above its own noise, that over twice the root; below, the root of the noise.
  const double noise = std::sqrt(s.variance) / s.count / (mean * mean);
  score.uncertainty = std::sqrt(score.rmse * score.rmse + noise) - score.rmse;
  score.rmseAfterGain = rmse(score.gain);
  score.flip = compare(image, truth.mean, {.exposure = exposure}).flip;
  score.flipAfterGain = compare(scaled(image, score.gain), truth.mean, {.exposure = exposure}).flip;
  score.seconds = Studio::secondsOf(image);
  return score;
}

std::vector<Column> scoreColumns() {
  return {{"RMSE, %", "relative_rmse", 1, 100},
          {"±", "relative_rmse_se", 1, 100},
          {"mean, %", "bias", 1, 100},
          {"best gain", "best_gain", 2},
          {"RMSE after gain, %", "relative_rmse_after_gain", 1, 100},
          {"FLIP", "flip", 3},
          {"FLIP after gain", "flip_after_gain", 3},
          {"time, s", "seconds", 2}};
}

std::vector<Cell> scoreCells(const Score& score) {
  return {score.rmse,          score.uncertainty, score.bias,          score.gain,
          score.rmseAfterGain, score.flip,        score.flipAfterGain, score.seconds};
}

std::string percent(double share) {
  return fmt::format("{:.{}f} %", 100 * share, share < 0.995 ? 1 : 0);
}

}  // namespace lychnite::paper
