#pragma once

#include <algorithm>
#include <vector>

#include "lychnite/optics/profile.h"
#include "reference/octree.h"
#include "reference/ray_scene.h"
#include "reference/surface_samples.h"

namespace lychnite {

/// Whether samples this far apart see the profile's peak as smooth.
bool resolves(const Profile& profile, double spacing);

/// How one object's kernel is cut: shell i holds what lies between radius[i - 1] (all of space for the first)
/// and radius[i], summed over one point in block[i] samples. Scene units.
struct ShellPlan {
  size_t samples = 0;          ///< surface samples
  std::vector<double> radius;  ///< inner radius of each shell, the widest first
  std::vector<size_t> block;
  bool near = false;  ///< probes take what is inside the last radius; else it is 0

  /// Samples when refined so many times: bounded, 8 Mi take about 500 MB while they are made.
  size_t refined(int refine) const { return std::min(samples * size_t(refine), size_t(8) << 20); }

  /// Samples until their spacing is a sixth of the profile's shortest core, at most `most`. The last radius
  /// is six spacings, each one before it twice the next; points lie at most a twelfth of their shell's inner
  /// radius apart (a sixth in the last), and the first shell has about `first` of them.
  ShellPlan(const SurfaceSampler& sampler, const Profile& profile, size_t first, size_t most);
};

/// One of every `block` sources along the curve, drawn by its flux, carrying what keeps the sum of any kernel
/// unbiased: the block's flux, if its sources share their colour.
FluxPoints thinned(const FluxPoints& sources, size_t block, uint64_t seed);

/// The longest distance between a receiver and a source.
double longestDistance(const PointGroups& receivers, const FluxPoints& sources);

/// One translucent object of a scene, the points of it where the radiosity is asked for, and the sums over
/// it.
class DipoleShells {
 public:
  DipoleShells(const RayScene& scene, int object, const Profile& profile, std::vector<RayHit> receivers,
               int light);

  const SurfaceSampler& sampler() const { return sampler_; }

  /// What the shells hold of every receiver's radiosity, with `refine` times the plan's points; sums of
  /// different seeds are independent.
  std::vector<Rgb> sumShells(const ShellPlan& plan, int refine, uint64_t seed, const Tick& tick) const;

  /// What is inside the plan's last radius, by `probes[i] * refine` probes.
  std::vector<Rgb> sumNear(const ShellPlan& plan, int refine, const std::vector<int>& probes, uint64_t seed,
                           const Tick& tick) const;

  /// NearField's planProbes for the plan's last radius.
  std::vector<int> planProbes(const ShellPlan& plan, double noise, uint64_t seed) const;

 private:
  void addFirst(const KernelTable& kernel, const FluxPoints& sources, std::vector<Rgb>& sums,
                const Tick& tick) const;
  void addShell(const KernelTable& kernel, const FluxOctree& tree, double radius, std::vector<Rgb>& sums,
                const Tick& tick) const;

  const RayScene& scene_;
  int object_, light_;
  const Profile& profile_;
  SurfaceSampler sampler_;
  std::vector<RayHit> receivers_;
  PointGroups groups_;
};

}  // namespace lychnite
