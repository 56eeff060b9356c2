#include "volume/smooth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lychnite::volume {

namespace {

constexpr float kWidth = 0.6f, kReach = 1.3f;  // of the kernel, in voxels: standard deviation, cut
constexpr float kFacing = 0.2f;                // least cosine between normals of one surface
constexpr float kPerCosine = 20;               // weights fall by e at 18 degrees between normals
constexpr int kScalings = 8;
constexpr size_t kBlock = 1024;

template <class Body>
void inBlocks(size_t count, Body body) {
  tbb::parallel_for(size_t(0), (count + kBlock - 1) / kBlock,
                    [&](size_t b) { body(b, b * kBlock, std::min(count, (b + 1) * kBlock)); });
}

}  // namespace

Smoother::Smoother(const Grid& grid, const Surface& surface) : surface_(surface) {
  const auto& nodes = surface.nodes();
  const auto h = float(grid.side());
  std::vector<std::vector<Pair>> parts((nodes.size() + kBlock - 1) / kBlock);
  std::vector<uint32_t> counts(nodes.size(), 0);
  inBlocks(nodes.size(), [&](size_t b, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const auto& a = nodes[i];
      const size_t before = parts[b].size();
      if (a.cell != Grid::kNone && a.area > 0)
        surface.around(a.position, [&](uint32_t n) {
          const auto& c = nodes[n];
          const float facing = glm::dot(a.normal, c.normal);
          const glm::vec3 way = c.position - a.position;
          const float d2 = glm::dot(way, way) / (h * h);
          if (c.cell == Grid::kNone || !(c.area > 0) || facing < kFacing || d2 > kReach * kReach ||
              !grid.linked(a.cell, c.cell))
            return;
          parts[b].push_back({n, std::exp((facing - 1) * kPerCosine - d2 / (2 * kWidth * kWidth))});
        });
      counts[i] = uint32_t(parts[b].size() - before);
    }
  });
  first_.push_back(0);
  for (const uint32_t n : counts) first_.push_back(first_.back() + n);
  pairs_.reserve(first_.back());
  for (const auto& part : parts) pairs_.insert(pairs_.end(), part.begin(), part.end());
  // Scale rows and columns alike until each row, weighted by area, sums to 1.
  std::vector<float> scale(nodes.size(), 1), next(nodes.size(), 1);
  for (int round = 0; round < kScalings; ++round) {
    inBlocks(nodes.size(), [&](size_t, size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        float sum = 0;
        for (uint32_t p = first_[i]; p < first_[i + 1]; ++p)
          sum += pairs_[p].weight * scale[pairs_[p].to] * nodes[pairs_[p].to].area;
        if (sum > 0) next[i] = std::sqrt(scale[i] / sum);
      }
    });
    std::swap(scale, next);
  }
  double spread = 0, area = 0;
  for (size_t i = 0; i < nodes.size(); ++i)
    for (uint32_t p = first_[i]; p < first_[i + 1]; ++p) {
      pairs_[p].weight *= scale[i] * scale[pairs_[p].to];
      const glm::vec3 way = nodes[pairs_[p].to].position - nodes[i].position;
      const double share =
          double(pairs_[p].weight) * double(nodes[i].area) * double(nodes[pairs_[p].to].area);
      spread += share * double(glm::dot(way, way)) / double(h * h);
      area += share;
    }
  if (area > 0) variance_ = 0.5 * spread / area;  // of each of the two directions
}

/// to = (1 - share) from + share * smoothed from.
void Smoother::step(const std::vector<Lanes>& from, std::vector<Lanes>& to, float share) const {
  const auto& nodes = surface_.nodes();
  inBlocks(nodes.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      if (first_[i] == first_[i + 1]) {
        to[i] = from[i];
        continue;
      }
      Lanes sum{0, 0, 0, 0};
      for (uint32_t p = first_[i]; p < first_[i + 1]; ++p) sum += pairs_[p].weight * from[pairs_[p].to];
      to[i] = (1 - share) * from[i] + share * nodes[i].area * sum;
    }
  });
}

std::vector<Lanes> Smoother::smoothed(const std::vector<Lanes>& flux, double sigma) const {
  std::vector<Lanes> now = flux, next(flux.size());
  for (double steps = sigma * sigma / variance_; steps > 1e-3; steps -= 1) {
    step(now, next, float(std::min(1.0, steps)));
    std::swap(now, next);
  }
  return now;
}

}  // namespace lychnite::volume
