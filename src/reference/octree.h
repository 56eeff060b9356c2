#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "reference/dipole_kernel.h"

namespace lychnite {

struct Box {
  glm::vec3 low{1e30f}, high{-1e30f};
  void add(const glm::vec3& p);
  void add(const Box& other);
  glm::vec3 centre() const { return 0.5f * (low + high); }
  /// Squared distance between the nearest points of two boxes.
  static float squaredGap(const Box& a, const Box& b);
};

/// Position of a point in the unit cube [0, 1]^3 along the Hilbert curve of 2^20 cells a side.
uint64_t hilbertIndex(const glm::vec3& inUnitCube);

/// Points put together that lie together: `order` is cut into groups of at most `size`, each with its box.
struct PointGroups {
  struct Group {
    uint32_t begin = 0, end = 0;  ///< into order
    Box box;
  };
  std::vector<uint32_t> order;
  std::vector<Group> groups;
  PointGroups(const std::vector<glm::vec3>& points, size_t size);
};

/// Called now and then with the fraction done, from the thread that waits; may throw to stop.
using Tick = std::function<void(double)>;

/// Calls work(group) for all groups in parallel, in a few slices with a tick after each.
void forGroups(const PointGroups& groups, const Tick& tick,
               const std::function<void(const PointGroups::Group&)>& work);

/// The octree of [J02 sect. 3.2]: flux gathered over eight children a node. The sources must come in the
/// order of a space-filling curve over the surface (SurfaceSampler); eight neighbours along it, not eight
/// cells of space, make a node, so that a node is one compact patch even where two sheets of the surface lie
/// in one cell.
class FluxOctree {
 public:
  /// `areaEach` is the surface that one source stands for. Sources of no flux may have been left out.
  FluxOctree(FluxPoints sources, double areaEach);

  /// Appends to `list` what stands for all sources as seen from anywhere in `box`: a node as one point at its
  /// flux-weighted centroid where its area over the squared distance (the solid angle of [J02 eq. 8]) is
  /// below `solidAngle` from all of the box, the sources themselves elsewhere.
  void gather(const Box& box, float solidAngle, FluxPoints& list) const;

  /// Appends the sources that may lie within `radius` of `box`, by whole leaves.
  void gatherNear(const Box& box, float radius, FluxPoints& list) const;

 private:
  struct Node {
    Box box;
    glm::vec3 centroid{0}, flux{0};
    float area = 0;
    uint32_t begin = 0, end = 0;       ///< sources
    uint32_t child = 0, childEnd = 0;  ///< nodes; none for a leaf
  };
  template <class Visit>
  void visit(const Box& box, FluxPoints& list, Visit decide) const;
  Node leaf(uint32_t begin, uint32_t end, double areaEach) const;
  Node parent(uint32_t child, uint32_t childEnd) const;

  FluxPoints sources_;
  std::vector<Node> nodes_;  ///< level by level, leaves first, the root last
};

}  // namespace lychnite
