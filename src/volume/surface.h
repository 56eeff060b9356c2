#pragma once

#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "volume/grid.h"

namespace lychnite::volume {

/// Four lanes, three of them channels.
typedef float Lanes __attribute__((vector_size(16)));

/// The surface of a shape as small flat pieces, local units: each triangle cut into m x m equal ones. Each
/// sample knows the cell behind it and how deep that cell's centroid lies under it. Nearby samples of one
/// cell and one orientation form a node: where light that leaves is gathered.
class Surface {
 public:
  Surface(const LocalMesh& mesh, const Grid& grid);

  struct Sample {
    glm::vec3 position{0}, normal{0};
    float area = 0;
    uint32_t cell = Grid::kNone;  ///< kNone where there is nothing behind: a sliver thinner than the columns
    float depth = 0;              ///< of the cell's centroid under the sample's plane, at least .05 voxel
    uint32_t triangle = 0;
    uint32_t node = 0;
  };
  struct Node {
    glm::vec3 position{0}, normal{0};  ///< means over its samples
    float area = 0;
    uint32_t cell = Grid::kNone;
  };

  const std::vector<Sample>& samples() const { return samples_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  double area() const { return area_; }
  const Grid& grid() const { return grid_; }

  /// The sample at barycentric weights (u, v) of a triangle's second and third corner.
  uint32_t sampleAt(uint32_t triangle, float u, float v) const;
  /// Barycentric weights of a point of a sample, evenly spread for even x and y in [0, 1).
  glm::vec2 pointOf(uint32_t sample, float x, float y) const;

  /// Where a point inside is: its cell (the nearest node's where the columns miss it), and the nearest sample
  /// of that cell's nearest node. `depth` is the distance under that sample's plane; sample kNone when the
  /// cell has no surface.
  struct Place {
    uint32_t cell = Grid::kNone, sample = Grid::kNone;
    float depth = 0;
  };
  Place place(const glm::vec3& p) const;

  /// Calls visit(node) for all nodes of the voxels that lie within one voxel of p's.
  template <class Visit>
  void around(const glm::vec3& p, Visit visit) const {
    const glm::ivec3 middle(glm::floor(grid_.voxels(p)));
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const glm::ivec3 v = middle + glm::ivec3(i, j, k);
          if (!grid_.contains(v)) continue;
          const size_t at = grid_.voxelIndex(v);
          for (uint32_t n = firstNode_[at]; n < firstNode_[at + 1]; ++n) visit(n);
        }
  }
  size_t memoryBytes() const;

 private:
  void cutTriangles(const LocalMesh& mesh);
  void findOwners();
  void makeNodes();
  void orderByCell();

  const Grid& grid_;
  std::vector<Sample> samples_;
  std::vector<Node> nodes_;
  std::vector<uint32_t> firstSample_;  ///< of each triangle
  std::vector<uint32_t> samplesOfNodes_, firstSampleOfNode_;
  std::vector<uint32_t> nodesOfCells_, firstOfCell_;
  std::vector<uint32_t> firstNode_;  ///< of each voxel
  double area_ = 0;
};

}  // namespace lychnite::volume
