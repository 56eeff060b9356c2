#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "volume/grid.h"

namespace lychnite::volume {

/// Sets that are joined step by step.
class Unions {
 public:
  explicit Unions(size_t count) : parent_(count) {
    for (size_t i = 0; i < count; ++i) parent_[i] = uint32_t(i);
  }
  uint32_t root(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The smaller number stays root, so that the result does not depend on the order.
  uint32_t join(uint32_t a, uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return a;
    if (b < a) std::swap(a, b);
    return parent_[b] = a;
  }

 private:
  std::vector<uint32_t> parent_;
};

/// Makes a grid's cells out of columns.
struct Grid::Builder {
  Builder(Grid& target, const Columns& lines) : grid(target), columns(lines) {}
  void build();

 private:
  /// A connected part of a voxel, before merging.
  struct Part {
    double volume = 0;
    glm::dvec3 moment{0};
    glm::ivec3 voxel{0};
  };
  struct Opening {
    uint32_t a, b;
    uint8_t axis;
    float area;
  };
  void cutSegments();
  void joinInVoxels();
  void measureParts();
  void findOpenings();
  void mergeSmall();
  void number();
  void link();
  size_t line(int i, int j) const { return size_t(j) * size_t(grid.width_) + size_t(i); }
  /// Calls visit(a, b, shared opening length) for touching segments of two neighbouring lines.
  template <class Visit>
  void touching(size_t lineA, size_t lineB, Visit visit) const;
  int layer(float at) const;

  Grid& grid;
  const Columns& columns;
  std::vector<int> layer_;      ///< voxel of each segment along the axis
  std::vector<uint32_t> part_;  ///< of each segment
  std::vector<Part> parts_;
  std::vector<Opening> openings_;
  std::vector<uint32_t> cellOf_;  ///< of each part
};

}  // namespace lychnite::volume
