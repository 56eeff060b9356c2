#pragma once

#include <vector>

#include "lychnite/optics/profile.h"
#include "reference/octree.h"
#include "reference/ray_scene.h"

namespace lychnite {

/// The near part of a profile, Rd(r) window(r, radius), which no affordable set of surface samples resolves
/// when the mean free path is far below the object's size. Kept as means over rings that hold the exact
/// integral of Rd (by differences of P), so that a singular profile is as good as any. Scene units.
class NearKernel {
 public:
  NearKernel(const Profile& profile, double radius);

  double radius() const { return radius_; }
  /// The integral over a plane through the receiver.
  const Rgb& mass() const { return mass_; }
  /// Mean kernel of the ring that holds r.
  const Rgb& kernel(double r) const { return rings_[ringOf(r)].kernel; }
  /// Probability per area of a probe at distance r in the plane: the channels' kernels, each over its mass,
  /// averaged.
  double density(double r) const { return rings_[ringOf(r)].density; }
  /// Distance of a probe for a uniform number in [0, 1).
  double sampleRadius(double u) const;

 private:
  struct Ring {
    double begin = 0, end = 0;
    Rgb kernel{0};
    double density = 0, cumulative = 0;
  };
  size_t ringOf(double r) const;

  double radius_, first_, inverseLogRatio_;
  Rgb mass_{0};
  std::vector<Ring> rings_;
};

std::vector<glm::vec3> positionsOf(const std::vector<RayHit>& hits);

/// One near-field estimate at a receiver.
struct NearEstimate {
  Rgb radiosity{0};
  double spread = 0;  ///< standard deviation of one probe's contribution, mean of the channels
};

/// Integrates the near kernel over the object's surface about `at` with probe rays through discs across the
/// normal and two tangents (King et al. 2013, combined by the power heuristic), spread by a shifted
/// Fibonacci lattice. The tangent plane under the receiver's own light is taken out exactly (a control
/// variate): flat, evenly lit surfaces have no noise, and a radius far below all features gives mass Ft E
/// cos. Unbiased for any probe count.
class NearField {
 public:
  NearField(const RayScene& scene, int object, const Profile& profile, double radius, int light);

  NearEstimate estimate(const RayHit& at, int probes, uint64_t seed) const;

  /// Probes for each receiver, so that its noise is about `noise` times the receivers' mean. From pilot
  /// estimates that are not used again, so that the choice does not bias what is estimated.
  std::vector<int> planProbes(const std::vector<RayHit>& receivers, const PointGroups& groups, double noise,
                              uint64_t seed) const;

  /// Adds an estimate of `refine` times probes[i] to sums[i] for every receiver.
  void add(const std::vector<RayHit>& receivers, const PointGroups& groups, const std::vector<int>& probes,
           int refine, uint64_t seed, const Tick& tick, std::vector<Rgb>& sums) const;

 private:
  struct Frame;
  void addHits(const Frame& frame, int axis, const glm::vec3& offset, class NearSum& sum) const;
  Rgb hitTerm(const Frame& frame, size_t axis, const RayHit& hit) const;

  const RayScene& scene_;
  int object_, light_;
  double eta_;
  NearKernel kernel_;
};

}  // namespace lychnite
