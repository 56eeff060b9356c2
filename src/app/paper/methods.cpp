#include "app/paper/methods.h"

namespace lychnite::paper {

std::vector<MethodColumn> comparedMethods() {
  return {{.name = "fixed", .label = "fixed", .method = Method::kFixed, .style = 5},
          {.name = "adaptive", .label = "adaptive", .method = Method::kAdaptive, .style = 1},
          {.name = "matched", .label = "matched", .method = Method::kMatched, .style = 2},
          {.name = "volume", .label = "volume", .method = Method::kVolume, .style = 3},
          {.name = "hierarchical", .label = "hierarchical", .method = Method::kHierarchical, .style = 4}};
}

Score scoreOf(const Image& image, const Image& walk, double exposure) {
  const Comparison comparison = compare(image, walk, {.exposure = exposure, .useStandardError = true});
  const Image gained = scaled(image, comparison.together.best_gain);
  return {.asItIs = comparison.together,
          .flip = comparison.flip,
          .flipAfterGain = compare(gained, walk, {.exposure = exposure}).flip,
          .seconds = Studio::secondsOf(image)};
}

std::vector<Column> scoreColumns() {
  return {{"RMSE, %", "relative_rmse", 1, 100},
          {"mean, %", "bias", 1, 100},
          {"best gain", "best_gain", 2},
          {"RMSE after gain, %", "relative_rmse_after_gain", 1, 100},
          {"FLIP", "flip", 3},
          {"FLIP after gain", "flip_after_gain", 3},
          {"time, s", "seconds", 2}};
}

std::vector<Cell> scoreCells(const Score& score) {
  return {score.asItIs.relative_rmse,
          score.asItIs.bias,
          score.asItIs.best_gain,
          score.asItIs.relative_rmse_after_gain,
          score.flip,
          score.flipAfterGain,
          score.seconds};
}

double noiseOf(const Image& walk) {
  const auto found = walk.metadata.find("noise");
  return found == walk.metadata.end() ? 0 : std::stod(found->second);
}

}  // namespace lychnite::paper
