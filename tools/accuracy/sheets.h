#pragma once

#include <filesystem>
#include <vector>

#include "models.h"
#include "references.h"

namespace lychnite::accuracy {

/// What sheets are made with.
struct Workshop {
  References& references;
  Models& models;
};

/// For each cell two rows: the walk and the columns at one exposure (the walk's 98th percentile), and their
/// errors. `pixels` wide and high each. Columns without order one are left out.
void writeSheet(const Workshop& workshop, const std::vector<Cell>& cells, std::vector<Column> columns,
                int pixels, const std::filesystem::path& path, const Progress& progress);

}  // namespace lychnite::accuracy
