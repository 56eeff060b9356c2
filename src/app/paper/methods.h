#pragma once

#include <string>
#include <vector>

#include "app/paper/studio.h"

namespace lychnite::paper {

/// A method as it appears in the comparisons.
struct MethodColumn {
  std::string name;   ///< of files
  std::string label;  ///< as shown
  Method method = Method::kMatched;
  LatticeConstants lattice;
  int style = 0;        ///< of its lines in charts
  bool inStrip = true;  ///< of the size ladder
};

/// fixed, adaptive, matched, volume, hierarchical.
std::vector<MethodColumn> comparedMethods();

/// The walk twice, independently, so that its noise is not counted as a method's error.
struct Truth {
  Image first, second, mean;
  double noise = 0;    ///< of the mean: root mean square of its standard error over its mean, covered pixels
  double seconds = 0;  ///< of both
};
/// Two steps. `settings` are of the walk; its noise and time limits are those of the mean.
Truth truthOf(Studio& studio, const std::string& name, const Scene& scene, const RenderSettings& settings);

/// How far a picture is from the truth, over the pixels that are covered whole, R, G, B together. Mean
/// squares are of (M - T1)(M - T2), to which the noise of T1 and T2 does not add; the FLIPs are against their
/// mean, noise included.
struct Score {
  double rmse = 0,
         uncertainty = 0;  ///< over the truth's mean; the standard error that the walks' noise leaves
  double bias = 0;         ///< of the mean, relative
  double gain = 1;         ///< the one factor that fits best
  double rmseAfterGain = 0;
  double flip = 0, flipAfterGain = 0;
  double seconds = 0;
};
/// `exposure` is for FLIP.
Score scoreOf(const Image& image, const Truth& truth, double exposure);

/// Columns of `scoreCells`, after what a table has of its own; the last is the time.
std::vector<Column> scoreColumns();
std::vector<Cell> scoreCells(const Score& score);

/// "12.3 %", "123 %".
std::string percent(double share);

}  // namespace lychnite::paper
