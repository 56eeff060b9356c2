#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lychnite::paper {

/// Values over x in one look of its own: dash, marker and colour go by `style`.
struct Series {
  std::string label;
  std::vector<double> x, y;  ///< not-a-number and what is not above 0 is left out
  int style = 0;
};

/// Both axes are logarithmic; ranges are whole decades around the values unless given.
struct Chart {
  std::string title, xLabel, yLabel;
  std::vector<Series> series;
  double yFrom = 0, yTo = 0;  ///< 0: by the values
  bool legend = true;
};

/// Draws the chart as SVG, whole or not at all. Throws Error when it cannot write.
void writeChart(const Chart& chart, const std::filesystem::path& path);

}  // namespace lychnite::paper
