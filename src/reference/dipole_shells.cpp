#include "reference/dipole_shells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "reference/dipole_kernel.h"
#include "reference/dipole_near_field.h"

namespace lychnite {
namespace {

constexpr double kReach = 6;   ///< a shell's inner radius over its spacing
constexpr size_t kGroup = 64;  ///< receivers that share a list of sources

double shortestCore(const Profile& profile) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int c = 0; c < 3; ++c)
    if (profile.coreLength()[c] > 0) shortest = std::min(shortest, profile.coreLength()[c]);
  return shortest;
}

}  // namespace

bool resolves(const Profile& profile, double spacing) {
  const Rgb peak = profile.Rd(0), beside = profile.Rd(2 * spacing);
  for (int c = 0; c < 3; ++c)
    if (peak[c] > 1.25 * beside[c]) return false;
  return true;
}

ShellPlan::ShellPlan(const SurfaceSampler& sampler, const Profile& profile, size_t first, size_t most)
    : samples(4 * first) {
  const double core = shortestCore(profile);
  while (sampler.spacing(samples) > core / 6 && 4 * samples <= most) samples *= 4;
  near = !resolves(profile, sampler.spacing(samples));
  radius = {near ? kReach * sampler.spacing(samples) : 0};
  block = {1};
  while (samples / block.front() > first) {
    block.insert(block.begin(), radius.size() > 1 ? 4 * block.front() : 1);
    radius.insert(radius.begin(), 2 * kReach * sampler.spacing(samples / block.front()));
  }
}

double longestDistance(const PointGroups& groups, const FluxPoints& sources) {
  Box box;
  for (const PointGroups::Group& group : groups.groups) box.add(group.box);
  for (size_t i = 0; i < sources.size(); ++i) box.add({sources.x[i], sources.y[i], sources.z[i]});
  return glm::distance(box.low, box.high);
}

FluxPoints thinned(const FluxPoints& sources, size_t block, uint64_t seed) {
  FluxPoints result;
  result.reserve(sources.size() / block + 1);
  const auto weight = [&](size_t i) {
    return double(sources.flux[0][i]) + double(sources.flux[1][i]) + double(sources.flux[2][i]);
  };
  for (size_t begin = 0; begin < sources.size(); begin += block) {
    const size_t end = std::min(sources.size(), begin + block);
    double total = 0;
    for (size_t i = begin; i < end; ++i) total += weight(i);
    double left = uniformAt(seed, begin / block) * total;
    size_t chosen = begin;
    while (chosen + 1 < end && left >= weight(chosen)) left -= weight(chosen++);
    const glm::vec3 flux(sources.flux[0][chosen], sources.flux[1][chosen], sources.flux[2][chosen]);
    result.add({sources.x[chosen], sources.y[chosen], sources.z[chosen]},
               flux * float(total / weight(chosen)));
  }
  return result;
}

DipoleShells::DipoleShells(const RayScene& scene, int object, const Profile& profile,
                           std::vector<RayHit> receivers, int light)
    : scene_(scene),
      object_(object),
      light_(light),
      profile_(profile),
      sampler_(scene.mesh(object)),
      receivers_(std::move(receivers)),
      groups_(positionsOf(receivers_), kGroup) {}

void DipoleShells::addFirst(const KernelTable& kernel, const FluxPoints& sources, std::vector<Rgb>& sums,
                            const Tick& tick) const {
  constexpr size_t kChunk = 16384;  // sources that stay in the cache while a group's receivers pass
  forGroups(groups_, tick, [&](const PointGroups::Group& group) {
    for (size_t begin = 0; begin < sources.size(); begin += kChunk)
      for (uint32_t i = group.begin; i < group.end; ++i) {
        const uint32_t receiver = groups_.order[i];
        sums[receiver] += sumKernel(kernel, receivers_[receiver].position, sources, begin,
                                    std::min(sources.size(), begin + kChunk));
      }
  });
}

void DipoleShells::addShell(const KernelTable& kernel, const FluxOctree& tree, double radius,
                            std::vector<Rgb>& sums, const Tick& tick) const {
  forGroups(groups_, tick, [&](const PointGroups::Group& group) {
    FluxPoints list;
    tree.gatherNear(group.box, float(radius), list);
    for (uint32_t i = group.begin; i < group.end; ++i) {
      const uint32_t receiver = groups_.order[i];
      sums[receiver] += sumKernel(kernel, receivers_[receiver].position, list, 0, list.size());
    }
  });
}

std::vector<Rgb> DipoleShells::sumShells(const ShellPlan& plan, int refine, uint64_t seed,
                                         const Tick& tick) const {
  std::vector<Rgb> sums(receivers_.size(), Rgb(0));
  double done = 0;
  const Tick part = [&](double fraction) { tick((done + fraction) / double(plan.radius.size())); };
  const size_t n = plan.refined(refine);
  const FluxPoints all = litSamples(scene_, object_, sampler_, n, seed, light_);
  const double reach = longestDistance(groups_, all);
  for (size_t shell = 0; shell < plan.radius.size(); ++shell, ++done) {
    const size_t block = plan.block[shell];
    const KernelTable kernel(profile_, plan.radius[shell], shell ? plan.radius[shell - 1] : 0, reach);
    FluxPoints sources = block > 1 ? thinned(all, block, seed * 64 + shell) : all;
    if (shell == 0)
      addFirst(kernel, sources, sums, part);
    else
      addShell(kernel, FluxOctree(std::move(sources), sampler_.area() * double(block) / double(n)),
               plan.radius[shell - 1], sums, part);
  }
  return sums;
}

std::vector<Rgb> DipoleShells::sumNear(const ShellPlan& plan, int refine, const std::vector<int>& probes,
                                       uint64_t seed, const Tick& tick) const {
  std::vector<Rgb> sums(receivers_.size(), Rgb(0));
  if (!plan.near) return sums;
  const NearField near(scene_, object_, profile_, plan.radius.back(), light_);
  near.add(receivers_, groups_, probes, refine, seed, tick, sums);
  return sums;
}

std::vector<int> DipoleShells::planProbes(const ShellPlan& plan, double noise, uint64_t seed) const {
  if (!plan.near) return {};
  const NearField near(scene_, object_, profile_, plan.radius.back(), light_);
  return near.planProbes(receivers_, groups_, noise, seed);
}

}  // namespace lychnite
