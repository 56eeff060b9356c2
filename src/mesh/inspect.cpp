#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "lychnite/mesh/load.h"
#include "mesh/topology.h"

namespace lychnite {
namespace {

class Forest {
 public:
  explicit Forest(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  uint32_t root(uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void join(uint32_t a, uint32_t b) {
    a = root(a);
    b = root(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> parent_;
};

size_t countComponents(const Mesh& mesh, const std::vector<uint32_t>& same) {
  Forest forest(mesh.positions.size());
  std::vector<bool> used(mesh.positions.size(), false);
  for (const glm::uvec3& t : mesh.triangles) {
    forest.join(same[t.x], same[t.y]);
    forest.join(same[t.x], same[t.z]);
    used[same[t.x]] = used[same[t.y]] = used[same[t.z]] = true;
  }
  size_t components = 0;
  for (uint32_t v = 0; v < used.size(); ++v) components += used[v] && forest.root(v) == v;
  return components;
}

}  // namespace

MeshInfo inspect(const Mesh& mesh) {
  MeshInfo info;
  info.vertices = mesh.positions.size();
  info.triangles = mesh.triangles.size();
  info.bounds = boundsOf(mesh);
  info.memory_bytes = mesh.memoryBytes();
  const std::vector<uint32_t> same = firstEquals(mesh.positions);
  info.components = countComponents(mesh, same);
  const EdgeFacts edges = edgeFacts(mesh.triangles, same);
  info.boundary_edges = edges.boundary;
  info.non_manifold_edges = edges.non_manifold;
  info.closed = edges.closed() && !mesh.triangles.empty();
  for (const glm::uvec3& t : mesh.triangles) info.area += 0.5 * glm::length(areaVector(mesh, t));
  info.volume = signedVolume(mesh, info.bounds);
  return info;
}

}  // namespace lychnite
