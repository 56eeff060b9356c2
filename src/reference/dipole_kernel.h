#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "lychnite/optics/profile.h"

namespace lychnite {

/// Smooth cut of a radial kernel: 1 at r = 0, 0 from r = radius on, once differentiable.
double windowAt(double r, double radius);

/// The part of a profile between two windows, Rd(r) (window(r, outer) - window(r, inner)), as linear pieces
/// in r^2, 64 to each doubling: an error below 1.2e-4 of a dipole's value. Made for sums of billions of
/// terms. Lengths in scene units. `inner` 0 leaves the peak in, `outer` 0 (or infinite) the tail.
class KernelTable {
 public:
  /// `reach` is the longest distance that will be asked for.
  KernelTable(const Profile& profile, double inner, double outer, double reach);

  float offset() const { return offset_; }  ///< added to r^2 before the look-up
  int first() const { return first_; }      ///< high bits of the first entry
  int last() const { return int(value_[0].size()) - 1; }
  const float* value(int channel) const { return value_[channel].data(); }
  const float* slope(int channel) const { return slope_[channel].data(); }

  /// Bits of a float below the table's resolution: 2^(23 - 17) entries to each doubling.
  static constexpr int kShift = 17;

 private:
  float offset_;
  int first_;
  std::vector<float> value_[3], slope_[3];
};

/// Point sources of flux, one array a coordinate, for the vector units.
struct FluxPoints {
  std::vector<float> x, y, z, flux[3];

  size_t size() const { return x.size(); }
  void reserve(size_t n);
  void clear();
  void add(const glm::vec3& position, const glm::vec3& phi);
  /// Copies [begin, end) of another list to the end of this one.
  void append(const FluxPoints& other, size_t begin, size_t end);
};

/// The sum over the sources [begin, end) of kernel(|x_s - x_o|) flux_s.
Rgb sumKernel(const KernelTable& kernel, const glm::vec3& receiver, const FluxPoints& sources, size_t begin,
              size_t end);

}  // namespace lychnite
