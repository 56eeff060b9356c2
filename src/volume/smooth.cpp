#include "volume/smooth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace lychnite::volume {

namespace {

constexpr float kWidth = 0.6f,
                kReach = 1.3f;    // of the kernel, in voxels: standard deviation, cut
constexpr float kFacing = 0.2f;   // least cosine between normals of one surface
constexpr float kPerCosine = 20;  // weights fall by e at 18 degrees between normals
constexpr int kScalings = 8;
constexpr double kLeastSeen = 0.02;  // of the kernel's response: shorter waves are filtered as this one
constexpr int kMostDegree = 32;
constexpr float kTail = 0.005f;  // of a filter's coefficients, left out together
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

Smoother::Filter Smoother::filter(const Response& response) const {
  constexpr int kPoints = 128;
  std::vector<Lanes> value(kPoints);
  for (int j = 0; j < kPoints; ++j) {
    const double x = std::max(kLeastSeen, std::cos(std::numbers::pi * (j + 0.5) / kPoints));
    const double q = std::sqrt(-2 * std::log(x) / variance_);
    for (int c = 0; c < 4; ++c) value[size_t(j)][c] = float(response(q, c % 3));
  }
  Filter coefficients(kMostDegree + 1, Lanes{0, 0, 0, 0});
  for (int k = 0; k <= kMostDegree; ++k) {
    Lanes& sum = coefficients[size_t(k)];
    for (int j = 0; j < kPoints; ++j)
      sum += value[size_t(j)] * float(std::cos(std::numbers::pi * k * (j + 0.5) / kPoints));
    sum *= (k == 0 ? 1.0f : 2.0f) / kPoints;
  }
  float tail = 0;
  while (coefficients.size() > 2) {
    const Lanes& last = coefficients.back();
    tail += std::max({std::abs(last[0]), std::abs(last[1]), std::abs(last[2])});
    if (tail > kTail) break;
    coefficients.pop_back();
  }
  // What is the same everywhere is filtered exactly, whatever the polynomial leaves out.
  Lanes sum{0, 0, 0, 0};
  for (const Lanes& c : coefficients) sum += c;
  for (int c = 0; c < 4; ++c) coefficients[0][c] += float(response(0, c % 3)) - sum[c];
  return coefficients;
}

/// Chebyshev's recurrence T(n + 1) = 2 S T(n) - T(n - 1) for several fluxes side by side, so that the kernel
/// S is read once for all.
template <size_t kTasks>
std::vector<std::vector<std::vector<Lanes>>> Smoother::filteredTogether(
    const std::vector<Task>& tasks) const {
  using Row = std::array<Lanes, kTasks>;
  const auto& nodes = surface_.nodes();
  const size_t n = nodes.size();
  std::vector<std::vector<std::vector<Lanes>>> result(kTasks);
  std::vector<Row> before(n), now(n), next(n);
  size_t terms = 2;
  for (size_t t = 0; t < kTasks; ++t) {
    for (const Filter& f : tasks[t].filters) terms = std::max(terms, f.size());
    result[t].assign(tasks[t].filters.size(), std::vector<Lanes>(n, Lanes{0, 0, 0, 0}));
    for (size_t i = 0; i < n; ++i) before[i][t] = tasks[t].flux[i];
  }
  const auto add = [&](size_t term, size_t i, const Row& row) {
    for (size_t t = 0; t < kTasks; ++t)
      for (size_t f = 0; f < tasks[t].filters.size(); ++f)
        if (term < tasks[t].filters[f].size()) result[t][f][i] += tasks[t].filters[f][term] * row[t];
  };
  const auto spread = [&](const std::vector<Row>& from, size_t i) {
    if (first_[i] == first_[i + 1]) return from[i];
    Row sum;
    sum.fill(Lanes{0, 0, 0, 0});
    for (uint32_t p = first_[i]; p < first_[i + 1]; ++p)
      for (size_t t = 0; t < kTasks; ++t) sum[t] += pairs_[p].weight * from[pairs_[p].to][t];
    for (Lanes& lanes : sum) lanes *= nodes[i].area;
    return sum;
  };
  inBlocks(n, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      add(0, i, before[i]);
      add(1, i, now[i] = spread(before, i));
    }
  });
  for (size_t term = 2; term < terms; ++term) {
    inBlocks(n, [&](size_t, size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        next[i] = spread(now, i);
        for (size_t t = 0; t < kTasks; ++t) next[i][t] = 2 * next[i][t] - before[i][t];
        add(term, i, next[i]);
      }
    });
    std::swap(before, now);
    std::swap(now, next);
  }
  return result;
}

std::vector<std::vector<std::vector<Lanes>>> Smoother::filtered(const std::vector<Task>& tasks) const {
  switch (tasks.size()) {
    case 1:
      return filteredTogether<1>(tasks);
    case 2:
      return filteredTogether<2>(tasks);
    case 3:
      return filteredTogether<3>(tasks);
    default:
      return filteredTogether<4>(tasks);
  }
}

}  // namespace lychnite::volume
