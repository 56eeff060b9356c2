#pragma once

#include <functional>
#include <vector>

#include "volume/surface.h"

namespace lychnite::volume {

/// Spreads flux over the nodes of a surface: a symmetric kernel between nodes that face the same way and lie
/// on the same or neighbouring cells, scaled (Sinkhorn & Knopp 1967) so that it conserves flux and leaves a
/// constant radiosity as it is, at edges too. It stands for exp(-q^2 v / 2) at wave number q, v its variance;
/// a filter of any other response is a polynomial in it (Hammond et al. 2011).
class Smoother {
 public:
  Smoother(const Grid& grid, const Surface& surface);

  /// Of a filter at wave number q, radians per voxel, for a channel.
  using Response = std::function<double(double q, int channel)>;
  /// Chebyshev coefficients, per channel.
  using Filter = std::vector<Lanes>;
  /// Exact at q = 0; waves that the kernel leaves less than a fiftieth of are treated alike.
  Filter filter(const Response& response) const;

  /// Filters for one flux per node. All fluxes and filters together cost little more than the widest filter.
  struct Task {
    std::vector<Lanes> flux;
    std::vector<Filter> filters;
  };
  /// What each task's filters make of its flux. 1 to 4 tasks.
  std::vector<std::vector<std::vector<Lanes>>> filtered(const std::vector<Task>& tasks) const;
  size_t memoryBytes() const { return first_.capacity() * 4 + pairs_.capacity() * sizeof(Pair); }

 private:
  struct Pair {
    uint32_t to;
    float weight;
  };
  template <size_t kTasks>
  std::vector<std::vector<std::vector<Lanes>>> filteredTogether(const std::vector<Task>& tasks) const;

  const Surface& surface_;
  double variance_ = 1;  ///< of one step, voxels squared
  std::vector<uint32_t> first_;
  std::vector<Pair> pairs_;
};

}  // namespace lychnite::volume
