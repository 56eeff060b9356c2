#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/paper/studio.h"
#include "lychnite/image/metrics.h"

namespace lychnite::paper {

/// A method as it appears in the comparisons.
struct MethodColumn {
  std::string name;   ///< of files
  std::string label;  ///< as shown
  Method method = Method::kMatched;
  LatticeConstants lattice;
  int style = 0;  ///< of its lines in charts
};

/// fixed, adaptive, matched, volume, hierarchical.
std::vector<MethodColumn> comparedMethods();

/// How far a picture is from the walk's.
struct Score {
  Metrics asItIs;  ///< of R, G, B together
  double flip = 0, flipAfterGain = 0;
  double seconds = 0;
};
/// `exposure` is for FLIP. The walk's own noise (its layer "stderr") is taken out of the RMSE.
Score scoreOf(const Image& image, const Image& walk, double exposure);

/// Columns of `scoreCells`, after what a table has of its own.
std::vector<Column> scoreColumns();
std::vector<Cell> scoreCells(const Score& score);

/// The walk's relative noise as its metadata says, and how long it took.
double noiseOf(const Image& walk);

}  // namespace lychnite::paper
