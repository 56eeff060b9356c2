#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cells.h"

namespace lychnite::accuracy {

/// What light is judged on.
enum class Unit { kSurface, kPicture };

/// What is made of what is not there yet.
enum class Make {
  kAll,
  kReferences,  ///< nothing else
  kScores,      ///< of cells whose references are there
  kNothing
};

struct Options {
  std::filesystem::path references, models, scores, pictures, sheets;
  Unit unit = Unit::kSurface;
  Make make = Make::kAll;
  Choice choice;
  std::vector<std::string> columns;
  double seconds = 0, noise = 0;  ///< of a reference
  bool renew = false;             ///< references that are too noisy
  int threads = 0;                ///< 0 = all cores
};

/// Nothing where the help was asked for, and printed. Throws Error (Kind::kUsage).
std::optional<Options> parseOptions(int argc, char** argv);

}  // namespace lychnite::accuracy
