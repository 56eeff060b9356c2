#pragma once

#include <string>
#include <vector>

#include "app/paper/report.h"

namespace lychnite::paper {

struct Page {
  std::string version, date, device;
  bool quick = false;
  std::vector<Report> reports;                               ///< finished parts, in the order of the page
  std::vector<std::pair<std::string, std::string>> missing;  ///< names and titles of the parts that are not
};

/// The whole page: inline style, no script, files beside it by relative names.
std::string htmlOf(const Page& page);

}  // namespace lychnite::paper
