#pragma once

#include <vector>

#include "volume/body.h"

namespace lychnite::volume {

/// Mean of a node quantity (flux per node, over the nodes' areas) about a surface point: a Gaussian kernel
/// over nodes that face the same way and lie on the same or a neighbouring cell, so that nothing crosses a
/// fold or a thin wall. Means of constants are exact.
class Gather {
 public:
  static constexpr float kWidth = 0.5f;  ///< standard deviation of the kernel, in voxels
  struct Weight {
    uint32_t node;
    float weight;  ///< over the sum of weight times area
  };
  /// Weights for a point, local units, of a surface whose interpolated normal there is given, over `cell`.
  static void weigh(const Shape& shape, const glm::vec3& p, const glm::vec3& normal, uint32_t cell,
                    std::vector<Weight>& weights);

  static void weigh(const Shape& shape, const MeshPoint& point, std::vector<Weight>& weights);

  /// For all vertices of a mesh, kept.
  explicit Gather(const Shape& shape);
  std::vector<glm::vec3> vertices(const std::vector<Lanes>& flux) const;
  size_t memoryBytes() const { return first_.capacity() * 4 + weights_.capacity() * sizeof(Weight); }

 private:
  std::vector<uint32_t> first_;
  std::vector<Weight> weights_;
};

}  // namespace lychnite::volume
