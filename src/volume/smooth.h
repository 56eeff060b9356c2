#pragma once

#include <vector>

#include "volume/surface.h"

namespace lychnite::volume {

/// Spreads flux over the nodes of a surface: a symmetric kernel between nodes that face the same way and lie
/// on the same or neighbouring cells, scaled (Sinkhorn & Knopp 1967) so that it conserves flux and leaves a
/// constant radiosity as it is, at edges too. Wider kernels are made by repetition.
class Smoother {
 public:
  Smoother(const Grid& grid, const Surface& surface);

  /// Flux per node after smoothing by a standard deviation of about `sigma` voxels; for small sigma a part of
  /// a step.
  std::vector<Lanes> smoothed(const std::vector<Lanes>& flux, double sigma) const;
  size_t memoryBytes() const { return first_.capacity() * 4 + pairs_.capacity() * sizeof(Pair); }

 private:
  struct Pair {
    uint32_t to;
    float weight;
  };
  void step(const std::vector<Lanes>& from, std::vector<Lanes>& to, float share) const;

  const Surface& surface_;
  double variance_ = 1;  ///< of one step, voxels squared
  std::vector<uint32_t> first_;
  std::vector<Pair> pairs_;
};

}  // namespace lychnite::volume
