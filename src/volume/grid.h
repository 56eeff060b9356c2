#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "volume/columns.h"

namespace lychnite::volume {

/// The inside of a shape cut into cells for the diffusion solve, local units. A cell is the part of a voxel
/// that hangs together: the two sides of a fold or of a slit narrower than a voxel are different cells, so no
/// light leaks from one to the other. Parts smaller than a quarter of a voxel join the neighbour that they
/// share the widest opening with.
class Grid {
 public:
  static constexpr uint32_t kNone = ~0u;
  /// `cells` voxels along the longest side.
  Grid(const LocalMesh& mesh, int cells);

  struct Cell {
    glm::vec3 centroid{0};
    float volume = 0;
  };
  struct Link {
    uint32_t to;
    float conductance;  ///< opening over the distance of the centroids across it, at least .4 voxel; length
  };

  double side() const { return side_; }  ///< of a voxel
  double undefinedShare() const { return undefined_; }
  size_t size() const { return cells_.size(); }
  const Cell& cell(size_t i) const { return cells_[i]; }
  const Link* linksBegin(size_t i) const { return links_.data() + firstLink_[i]; }
  const Link* linksEnd(size_t i) const { return links_.data() + firstLink_[i + 1]; }

  /// Whether two cells are the same or share an opening.
  bool linked(uint32_t a, uint32_t b) const {
    if (a == b) return true;
    for (const Link* link = linksBegin(a); link != linksEnd(a); ++link)
      if (link->to == b) return true;
    return false;
  }

  /// Position in voxels.
  glm::vec3 voxels(const glm::vec3& p) const { return (p - origin_) * perSide_; }
  bool contains(const glm::ivec3& voxel) const {
    return voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x < counts_.x && voxel.y < counts_.y &&
           voxel.z < counts_.z;
  }
  size_t voxelIndex(const glm::ivec3& v) const {
    return (size_t(v.z) * size_t(counts_.y) + size_t(v.y)) * size_t(counts_.x) + size_t(v.x);
  }
  size_t voxelCount() const { return size_t(counts_.x) * size_t(counts_.y) * size_t(counts_.z); }
  /// The cell that holds p; kNone outside of the shape (as the columns see it).
  uint32_t find(const glm::vec3& p) const;
  /// Distance from p that is surely inside one solid region, 0 near surfaces.
  float clear(const glm::vec3& p) const {
    const glm::ivec3 v(glm::vec3(voxels(p)));
    return contains(v) ? float(depth_[voxelIndex(v)]) * float(side_) : 0.0f;
  }
  size_t memoryBytes() const;

 private:
  struct Builder;
  static constexpr uint32_t kSeveral = ~0u - 1;  ///< a voxel that holds more than one cell

  /// Part of a line that lies in one voxel; sorted along the line.
  struct Segment {
    float low, high;
    uint32_t cell;
  };
  void findDepths();

  double side_ = 1;
  float perSide_ = 1, pitch_ = 1;
  int axis_ = 0, perCell_ = 1, width_ = 0;
  glm::vec3 origin_{0};
  glm::ivec3 counts_{0};
  double undefined_ = 0;
  std::vector<Cell> cells_;
  std::vector<uint32_t> firstLink_;
  std::vector<Link> links_;
  std::vector<uint32_t> voxelCell_;     ///< kNone, kSeveral or the cell
  std::vector<uint8_t> depth_;          ///< voxels between this one and the nearest that is not full
  std::vector<uint32_t> firstSegment_;  ///< of each line
  std::vector<Segment> segments_;
};

}  // namespace lychnite::volume
