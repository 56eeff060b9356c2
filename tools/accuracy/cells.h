#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lychnite/scene/scene.h"

namespace lychnite::accuracy {

/// One case of the study: a shape at its true size, of one material, in one light.
struct Cell {
  std::string shape, material;
  double size = 0;    ///< mm, the longest side
  std::string light;  ///< front, side or behind
  double g = 0;       ///< mean cosine, at the material's sigma_sp

  std::string name() const;
  auto operator<=>(const Cell&) const = default;
};

/// What a study is made of, in the order of the tables.
struct Choice {
  std::vector<std::string> shapes, materials, lights;
  std::vector<double> sizes, gs;
};
/// The whole study, docs/accuracy.md's.
const Choice& everything();

/// The chosen cells; throws Error (Kind::kUsage) for lights and materials that there are not. With g other
/// than 0 there are those of everything()'s anisotropic set only: sphere, figurine and bunny_filled of fig6
/// and skin1. In an order that has no system but is always the same, so that any first part of them is a
/// cross-section.
std::vector<Cell> cellsOf(const Choice& choice);

/// Loads each shape once: the rounded plate, NAME.ply of the folder where there is one, else the built-in
/// model.
class Shapes {
 public:
  explicit Shapes(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Throws Error (Kind::kUsage) where it is neither.
  const Object& at(const std::string& name);
  Scene sceneOf(const Cell& cell);

 private:
  std::filesystem::path folder_;
  std::map<std::string, Object> objects_;
};

}  // namespace lychnite::accuracy
