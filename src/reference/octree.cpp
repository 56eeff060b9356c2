#include "reference/octree.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

namespace lychnite {
namespace {

constexpr uint32_t kLeaf = 16;
constexpr uint32_t kChildren = 8;

enum class Decision { kSkip, kOpen, kPoint };

float luminance(const glm::vec3& flux) {
  return flux.x + flux.y + flux.z;
}

/// Area of a disc that lies flat in a box: what a patch spread thinly over a large box counts as.
float discArea(const Box& box) {
  const glm::vec3 diagonal = box.high - box.low;
  return 0.4f * glm::dot(diagonal, diagonal);
}

}  // namespace

void Box::add(const glm::vec3& p) {
  low = glm::min(low, p);
  high = glm::max(high, p);
}

void Box::add(const Box& other) {
  low = glm::min(low, other.low);
  high = glm::max(high, other.high);
}

float Box::squaredGap(const Box& a, const Box& b) {
  const glm::vec3 gap = glm::max(glm::max(a.low - b.high, b.low - a.high), glm::vec3(0));
  return glm::dot(gap, gap);
}

uint64_t hilbertIndex(const glm::vec3& inUnitCube) {
  // Skilling 2004, "Programming the Hilbert curve".
  constexpr uint32_t kBits = 20;
  const glm::vec3 cell = glm::clamp(inUnitCube, 0.0f, 1.0f) * float((1 << kBits) - 1);
  std::array<uint32_t, 3> x{uint32_t(cell.x), uint32_t(cell.y), uint32_t(cell.z)};
  for (uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) {
    for (uint32_t& xi : x) {
      const uint32_t t = (x[0] ^ xi) & (q - 1);
      if (xi & q) {
        x[0] ^= q - 1;
      } else {
        x[0] ^= t;
        xi ^= t;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  uint32_t t = 0;
  for (uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1)
    if (x[2] & q) t ^= q - 1;
  uint64_t index = 0;
  for (int bit = kBits - 1; bit >= 0; --bit)
    for (uint32_t xi : x) index = index << 1 | (((xi ^ t) >> bit) & 1u);
  return index;
}

PointGroups::PointGroups(const std::vector<glm::vec3>& points, size_t size) : order(points.size()) {
  Box all;
  for (const glm::vec3& p : points) all.add(p);
  const glm::vec3 extent = all.high - all.low;
  const float side = std::max({extent.x, extent.y, extent.z, 1e-30f});
  std::vector<uint64_t> keys(points.size());
  tbb::parallel_for(size_t(0), points.size(),
                    [&](size_t i) { keys[i] = hilbertIndex((points[i] - all.low) / side); });
  std::iota(order.begin(), order.end(), 0u);
  tbb::parallel_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  for (size_t begin = 0; begin < points.size(); begin += size) {
    Group group{.begin = uint32_t(begin), .end = uint32_t(std::min(points.size(), begin + size)), .box = {}};
    for (uint32_t i = group.begin; i < group.end; ++i) group.box.add(points[order[i]]);
    groups.push_back(group);
  }
}

void forGroups(const PointGroups& groups, const Tick& tick,
               const std::function<void(const PointGroups::Group&)>& work) {
  const size_t count = groups.groups.size(), slice = std::max<size_t>(32, count / 32);
  for (size_t begin = 0; begin < count; begin += slice) {
    tbb::parallel_for(begin, std::min(count, begin + slice), [&](size_t i) { work(groups.groups[i]); });
    tick(std::min(1.0, double(begin + slice) / double(count)));
  }
}

FluxOctree::Node FluxOctree::leaf(uint32_t begin, uint32_t end, double areaEach) const {
  Node node;
  node.area = float(areaEach * (end - begin));
  node.begin = begin;
  node.end = end;
  float weight = 0;
  for (uint32_t i = begin; i < end; ++i) {
    const glm::vec3 p(sources_.x[i], sources_.y[i], sources_.z[i]);
    const glm::vec3 flux(sources_.flux[0][i], sources_.flux[1][i], sources_.flux[2][i]);
    node.box.add(p);
    node.flux += flux;
    node.centroid += luminance(flux) * p;
    weight += luminance(flux);
  }
  node.centroid = weight > 0 ? node.centroid / weight : node.box.centre();
  node.area = std::max(node.area, discArea(node.box));
  return node;
}

FluxOctree::Node FluxOctree::parent(uint32_t child, uint32_t childEnd) const {
  Node node;
  node.begin = nodes_[child].begin;
  node.end = nodes_[childEnd - 1].end;
  node.child = child;
  node.childEnd = childEnd;
  float weight = 0;
  for (uint32_t i = child; i < childEnd; ++i) {
    const Node& part = nodes_[i];
    node.box.add(part.box);
    node.flux += part.flux;
    node.area += part.area;
    node.centroid += luminance(part.flux) * part.centroid;
    weight += luminance(part.flux);
  }
  node.centroid = weight > 0 ? node.centroid / weight : node.box.centre();
  node.area = std::max(node.area, discArea(node.box));
  return node;
}

FluxOctree::FluxOctree(FluxPoints sources, double areaEach) : sources_(std::move(sources)) {
  const auto count = uint32_t(sources_.size());
  const uint32_t leaves = (count + kLeaf - 1) / kLeaf;
  nodes_.resize(leaves);
  tbb::parallel_for(0u, leaves, [&](uint32_t i) {
    nodes_[i] = leaf(i * kLeaf, std::min(count, (i + 1) * kLeaf), areaEach);
  });
  uint32_t begin = 0, end = leaves;
  while (end - begin > 1) {
    for (uint32_t i = begin; i < end; i += kChildren)
      nodes_.push_back(parent(i, std::min(end, i + kChildren)));
    begin = end;
    end = uint32_t(nodes_.size());
  }
}

template <class Visit>
void FluxOctree::visit(const Box& box, FluxPoints& list, Visit decide) const {
  if (nodes_.empty()) return;
  std::array<uint32_t, 256> stack;  // depth 11 at most, seven siblings waiting at each
  size_t top = 0;
  stack[top++] = uint32_t(nodes_.size() - 1);
  while (top > 0) {
    const Node& node = nodes_[stack[--top]];
    switch (decide(node, Box::squaredGap(node.box, box))) {
      case Decision::kSkip:
        break;
      case Decision::kPoint:
        list.add(node.centroid, node.flux);
        break;
      case Decision::kOpen:
        if (node.child == node.childEnd) list.append(sources_, node.begin, node.end);
        for (uint32_t i = node.child; i < node.childEnd; ++i) stack[top++] = i;
        break;
    }
  }
}

void FluxOctree::gather(const Box& box, float solidAngle, FluxPoints& list) const {
  visit(box, list, [&](const Node& node, float gap) {
    return node.area < solidAngle * gap ? Decision::kPoint : Decision::kOpen;
  });
}

void FluxOctree::gatherNear(const Box& box, float radius, FluxPoints& list) const {
  visit(box, list,
        [&](const Node&, float gap) { return gap < radius * radius ? Decision::kOpen : Decision::kSkip; });
}

}  // namespace lychnite
