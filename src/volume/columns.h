#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "lychnite/mesh/mesh.h"

namespace lychnite::volume {

/// A mesh in *local units*: centre of its box at the origin, longest side 1. Everything that depends on the
/// shape only lives here, whatever its size, place, material and light.
struct LocalMesh {
  explicit LocalMesh(const Mesh& mesh);
  std::vector<glm::dvec3> positions;
  const std::vector<glm::uvec3>* triangles;
  glm::dvec3 extent{0};  ///< of the box; the longest is 1
};

/// Parallel lines through a shape, on a square raster, and where they are inside it. The lines run along
/// `axis` (the shortest of the box, so that thin shapes are resolved exactly); u and v are the next two axes
/// in cyclic order.
class Columns {
 public:
  struct Interval {
    float low, high;  ///< along the axis
  };
  /// `pitch` between lines; the raster is centred on the box with whole `cell`s of `perCell` lines and a
  /// margin of one cell.
  Columns(const LocalMesh& mesh, double cell, int perCell);

  int axis() const { return axis_; }
  int u() const { return (axis_ + 1) % 3; }
  int v() const { return (axis_ + 2) % 3; }
  int perCell() const { return perCell_; }
  double pitch() const { return pitch_; }
  double cell() const { return pitch_ * perCell_; }
  glm::ivec3 cells() const { return cells_; }           ///< in mesh axes
  const glm::dvec3& origin() const { return origin_; }  ///< lowest corner of cell (0, 0, 0)
  int across(int direction) const { return cells_[direction] * perCell_; }

  /// Intervals of line (i, j), ascending and disjoint.
  const Interval* begin(int i, int j) const { return intervals_.data() + first_[index(i, j)]; }
  const Interval* end(int i, int j) const { return intervals_.data() + first_[index(i, j) + 1]; }

  /// Share of the lines through the shape along which inside is not defined: the crossings' winding does not
  /// return to outside, or leaves outside the wrong way. Such lines take the place of a neighbour's.
  double undefinedShare() const { return undefined_; }

 private:
  struct Crossing {
    float at;
    int8_t turn;  ///< +1 into the shape (surface faces down the axis), -1 out of it
  };
  size_t index(int i, int j) const { return size_t(j) * size_t(across(u())) + size_t(i); }
  std::vector<Crossing> crossings(const LocalMesh& mesh, std::vector<uint32_t>& first) const;
  void makeIntervals(std::vector<Crossing>& crossings, const std::vector<uint32_t>& first);

  int axis_ = 0, perCell_ = 1;
  double pitch_ = 0;
  glm::ivec3 cells_{0};
  glm::dvec3 origin_{0};
  std::vector<uint32_t> first_;
  std::vector<Interval> intervals_;
  double undefined_ = 0;
};

/// Share of undefined lines along the three axes on a raster of 96 lines across the longest side: the
/// largest. 0 for a closed mesh that is turned outwards, overlapping shells included.
double undefinedInside(const LocalMesh& mesh);

}  // namespace lychnite::volume
