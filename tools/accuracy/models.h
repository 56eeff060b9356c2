#pragma once

#include <map>
#include <string>
#include <vector>

#include "cells.h"
#include "lychnite/app/image_maker.h"
#include "lychnite/app/profile_store.h"
#include "lychnite/base/progress.h"
#include "score.h"

namespace lychnite::accuracy {

/// A method under test, and what of the walk it is held against.
struct Column {
  std::string name;
  Method method = Method::kHierarchical;
  ProfileKind profile = ProfileKind::kDipole;
  bool fromSecond = false;               ///< the radiance of orders two and up, not the whole radiosity
  int cells = 0;                         ///< of volume; 0 for its own choice
  int passes = RenderSettings{}.passes;  ///< of volume's photons; 0 for its first picture, without any
};

/// "volume[:CELLS[:PASSES]]", "first[:CELLS]" (a picture of volume without photons, as a window in motion
/// shows it), a profile (summed by hierarchical), "tabulated-two-up" (the same of orders two and up), or a
/// method. Throws Error (Kind::kUsage) with the nearest name.
Column columnOf(const std::string& text);
/// Throws Error (Kind::kUsage) for columns that tell no radiosity of all orders at points of a surface.
void requireOnSurface(const Column& column);

/// What columns say.
class Models {
 public:
  explicit Models(Shapes& shapes) : shapes_(shapes) {}

  /// Radiosity of kPatches patches, means over points of each, by two seeds where the column is random.
  /// `matched`, `adaptive` and `fixed` are read off by the sum of the profile that they stand for.
  Halves onSurface(const Cell& cell, const Column& column, const Progress& progress);
  /// One value a pixel: radiosity, or radiance where the column is held against that.
  Values inPicture(const Cell& cell, const Column& column, int pixels, const Progress& progress);

 private:
  const std::vector<MeshPoint>& pointsOf(const Cell& cell);

  Shapes& shapes_;
  ImageMaker maker_{{}};
  ProfileStore profiles_;
  std::map<std::string, std::vector<MeshPoint>> points_;  ///< by shape
};

/// Of the walk's or a method's picture: a layer, one value a pixel.
Values valuesOf(const Image& image, const std::string& layer);

}  // namespace lychnite::accuracy
