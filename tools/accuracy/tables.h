#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cells.h"
#include "score.h"

namespace lychnite::accuracy {

/// What one column scores in one cell: by each of the study's resolutions, the coarsest last.
using Scores = std::vector<Score>;
using Results = std::map<std::pair<std::string, Cell>, Scores>;  ///< by column and cell

struct TablePlan {
  std::vector<std::string> columns;
  std::vector<std::string> resolutions;  ///< as many as Scores, e.g. "400 patches"
  double mostUncertain = 0;              ///< standard error of a score that joins the means
};

/// Prints (markdown) for each column and resolution the means and worst cells by light and size, then for
/// each column every cell by the coarsest resolution, and those above what is asked: 6 %, and 10 % from 10 mm
/// up for columns "first...".
void printTables(const Choice& choice, const TablePlan& plan, const Results& results);

}  // namespace lychnite::accuracy
