#pragma once

#include <filesystem>
#include <optional>

#include "cells.h"
#include "lychnite/app/image_maker.h"
#include "lychnite/base/progress.h"
#include "lychnite/image/image.h"
#include "score.h"

namespace lychnite::accuracy {

constexpr size_t kPatches = 4000, kCoarsePatches = 400;  ///< equal areas that a surface is judged by

/// How long a reference is made.
struct Budget {
  double seconds = 0;  ///< at most, both halves together
  double noise = 0;    ///< of each half, standard error over mean, that is enough
};

/// The truth of one cell in a camera, twice, independently.
struct PictureTruth {
  Image half[2];  ///< with the layer "radiosity"
};

/// The walk's results in a folder: found there, else made and put there, whole or not at all.
class References {
 public:
  References(std::filesystem::path folder, const Budget& budget, Shapes& shapes)
      : folder_(std::move(folder)), budget_(budget), shapes_(shapes) {}

  /// When the newest file of a cell's truth was made; nothing where one is missing. `pixels` 0 for the
  /// surface.
  std::optional<std::filesystem::file_time_type> madeAt(const Cell& cell, int pixels) const;

  /// Radiosity of kPatches patches. Throws Interrupted.
  Halves surface(const Cell& cell, const Progress& progress);
  /// Whether a surface's truth is not there, or half as noisy again as the budget asks for and made in less
  /// than its time.
  bool isTooNoisy(const Cell& cell) const;
  /// Makes a surface's truth, whether it is there or not. Throws Interrupted.
  void makeSurface(const Cell& cell, const Progress& progress) const;
  /// Throws Interrupted.
  PictureTruth picture(const Cell& cell, int pixels, const Progress& progress);

 private:
  std::filesystem::path surfacePath(const Cell& cell) const { return folder_ / (cell.name() + ".exr"); }
  std::filesystem::path picturePath(const Cell& cell, int pixels, int half) const;
  Halves readSurface(const Cell& cell) const;
  Image pictureHalf(const Cell& cell, int pixels, int half, const Progress& progress);

  std::filesystem::path folder_;
  Budget budget_;
  Shapes& shapes_;
  ImageMaker maker_{{}};
};

}  // namespace lychnite::accuracy
