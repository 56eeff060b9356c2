#include "mesh/topology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/geometric.hpp>

namespace lychnite {
namespace {

using Key = std::array<uint32_t, 6>;

void putBits(Key& key, int at, const glm::vec3& v) {
  for (int i = 0; i < 3; ++i) key[at + i] = std::bit_cast<uint32_t>(v[i] + 0.0f);  // -0 + 0 is 0
}

uint64_t hashOf(const Key& key) {
  uint64_t hash = 0x9e3779b97f4a7c15ull;
  for (const uint32_t word : key) {
    hash = (hash ^ word) * 0xff51afd7ed558ccdull;
    hash ^= hash >> 32;
  }
  return hash;
}

// Directed edges gathered by their lower end, so that an edge's triangles lie side by side after a short
// sort.
struct EdgeBuckets {
  std::vector<size_t> begin;      // of vertex v's entries; one more than there are vertices
  std::vector<uint64_t> entries;  // upper end * 2 + (1 when the triangle runs downwards)
};

template <typename F>
void forEachEdge(const std::vector<glm::uvec3>& triangles, const std::vector<uint32_t>& same, F&& visit) {
  for (const glm::uvec3& t : triangles) {
    const uint32_t a = same[t.x], b = same[t.y], c = same[t.z];
    if (a == b || b == c || c == a) continue;
    visit(a, b);
    visit(b, c);
    visit(c, a);
  }
}

EdgeBuckets bucketEdges(const std::vector<glm::uvec3>& triangles, const std::vector<uint32_t>& same) {
  EdgeBuckets buckets;
  buckets.begin.assign(same.size() + 1, 0);
  forEachEdge(triangles, same, [&](uint32_t a, uint32_t b) { ++buckets.begin[std::min(a, b) + 1]; });
  for (size_t v = 0; v < same.size(); ++v) buckets.begin[v + 1] += buckets.begin[v];
  buckets.entries.resize(buckets.begin.back());
  std::vector<size_t> next(buckets.begin.begin(), buckets.begin.end() - 1);
  forEachEdge(triangles, same, [&](uint32_t a, uint32_t b) {
    buckets.entries[next[std::min(a, b)]++] = uint64_t{std::max(a, b)} * 2 + (a > b);
  });
  return buckets;
}

}  // namespace

std::vector<uint32_t> firstEquals(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals) {
  constexpr uint32_t kFree = UINT32_MAX;
  const auto keyOf = [&](uint32_t v) {
    Key key{};
    putBits(key, 0, positions[v]);
    if (!normals.empty()) putBits(key, 3, normals[v]);
    return key;
  };
  const size_t mask = std::bit_ceil(2 * positions.size() + 1) - 1;
  std::vector<uint32_t> table(mask + 1, kFree);
  std::vector<uint32_t> first(positions.size());
  for (uint32_t v = 0; v < positions.size(); ++v) {
    const Key key = keyOf(v);
    size_t slot = hashOf(key) & mask;
    while (table[slot] != kFree && keyOf(table[slot]) != key) slot = (slot + 1) & mask;
    if (table[slot] == kFree) table[slot] = v;
    first[v] = table[slot];
  }
  return first;
}

EdgeFacts edgeFacts(const std::vector<glm::uvec3>& triangles, const std::vector<uint32_t>& same) {
  EdgeBuckets buckets = bucketEdges(triangles, same);
  EdgeFacts facts;
  for (size_t v = 0; v + 1 < buckets.begin.size(); ++v) {
    const auto end = buckets.entries.begin() + buckets.begin[v + 1];
    auto at = buckets.entries.begin() + buckets.begin[v];
    std::sort(at, end);
    while (at != end) {
      const auto next = std::find_if(at, end, [&](uint64_t entry) { return entry / 2 != *at / 2; });
      if (next - at == 1) ++facts.boundary;
      if (next - at == 2 && at[0] == at[1]) ++facts.misdirected;
      if (next - at > 2) ++facts.non_manifold;
      at = next;
    }
  }
  return facts;
}

glm::dvec3 areaVector(const Mesh& mesh, const glm::uvec3& triangle) {
  const glm::dvec3 a = mesh.positions[triangle.x];
  return glm::cross(glm::dvec3(mesh.positions[triangle.y]) - a, glm::dvec3(mesh.positions[triangle.z]) - a);
}

double signedVolume(const Mesh& mesh, const Bounds& bounds) {
  double six_volumes = 0;
  for (const glm::uvec3& t : mesh.triangles)
    six_volumes += glm::dot(glm::dvec3(mesh.positions[t.x]) - bounds.centre(), areaVector(mesh, t));
  return six_volumes / 6;
}

}  // namespace lychnite
