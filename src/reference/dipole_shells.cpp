#include "reference/dipole_shells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "reference/dipole_kernel.h"
#include "reference/dipole_near_field.h"

namespace lychnite {
namespace {

constexpr double kReach = 6;                      ///< a shell's inner radius over its spacing
constexpr size_t kGroup = 64;                     ///< receivers that share a list of sources
constexpr size_t kMostSamples = 8 * 1024 * 1024;  ///< of a shell, whatever the refinement: about 500 MB
constexpr int kPilotProbes = 16;
constexpr size_t kNeighbours = 4;
constexpr int kMostProbes = 1024;

/// Whether samples this far apart see the kernel's peak as smooth.
bool resolves(const Profile& profile, double spacing) {
  const Rgb peak = profile.Rd(0), beside = profile.Rd(2 * spacing);
  for (int c = 0; c < 3; ++c)
    if (peak[c] > 1.25 * beside[c]) return false;
  return true;
}

double shortestCore(const Profile& profile) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int c = 0; c < 3; ++c)
    if (profile.coreLength()[c] > 0) shortest = std::min(shortest, profile.coreLength()[c]);
  return shortest;
}

std::vector<glm::vec3> positionsOf(const std::vector<RayHit>& hits) {
  std::vector<glm::vec3> positions;
  positions.reserve(hits.size());
  for (const RayHit& hit : hits) positions.push_back(hit.position);
  return positions;
}

/// The longest distance between a receiver and a source.
double longestDistance(const PointGroups& groups, const FluxPoints& sources) {
  Box box;
  for (const PointGroups::Group& group : groups.groups) box.add(group.box);
  for (size_t i = 0; i < sources.size(); ++i) box.add({sources.x[i], sources.y[i], sources.z[i]});
  return glm::distance(box.low, box.high);
}

}  // namespace

ShellPlan::ShellPlan(const SurfaceSampler& sampler, const Profile& profile, size_t first, size_t most)
    : samples(first) {
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

void forGroups(const PointGroups& groups, const Tick& tick,
               const std::function<void(const PointGroups::Group&)>& work) {
  const size_t count = groups.groups.size(), slice = std::max<size_t>(32, count / 32);
  for (size_t begin = 0; begin < count; begin += slice) {
    tbb::parallel_for(begin, std::min(count, begin + slice), [&](size_t i) { work(groups.groups[i]); });
    tick(std::min(1.0, double(begin + slice) / double(count)));
  }
}

FluxPoints litSamples(const RayScene& scene, int object, const SurfaceSampler& sampler, size_t n,
                      uint64_t seed, int light) {
  const std::vector<SurfacePoint> points = sampler.sample(n, seed);
  std::vector<glm::vec3> flux(n);
  const double area = sampler.area() / double(n), eta = scene.medium(object).eta;
  tbb::parallel_for(size_t(0), n, [&](size_t i) {
    flux[i] = glm::vec3(enteringIrradiance(scene, eta, points[i], light) * area);
  });
  FluxPoints lit;
  lit.reserve(n);
  for (size_t i = 0; i < n; ++i)
    if (flux[i] != glm::vec3(0)) lit.add(points[i].position, flux[i]);
  return lit;
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

std::vector<Rgb> DipoleShells::sum(const ShellPlan& plan, int refine, const std::vector<int>& probes,
                                   uint64_t seed, const Tick& tick) const {
  std::vector<Rgb> sums(receivers_.size(), Rgb(0));
  const double steps = double(plan.radius.size()) + (plan.near ? 1 : 0);
  double done = 0;
  const Tick part = [&](double fraction) { tick((done + fraction) / steps); };
  const size_t n = std::min(plan.samples * size_t(refine), kMostSamples);
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
  if (!plan.near) return sums;
  const NearField near(scene_, object_, profile_, plan.radius.back(), light_);
  forGroups(groups_, part, [&](const PointGroups::Group& group) {
    for (uint32_t i = group.begin; i < group.end; ++i) {
      const uint32_t r = groups_.order[i];
      sums[r] +=
          near.estimate(receivers_[r], probes[r] * refine, (seed * 64 + 63) * 0x100000000ull + r).radiosity;
    }
  });
  return sums;
}

std::vector<int> DipoleShells::planProbes(const ShellPlan& plan, double noise, uint64_t seed) const {
  std::vector<int> probes(receivers_.size(), kPilotProbes);
  if (!plan.near) return probes;
  const NearField near(scene_, object_, profile_, plan.radius.back(), light_);
  std::vector<NearEstimate> pilot(receivers_.size());
  tbb::parallel_for(size_t(0), pilot.size(), [&](size_t r) {
    pilot[r] = near.estimate(receivers_[r], kPilotProbes, seed * 0x100000000ull + r);
  });
  double mean = 0;
  for (const NearEstimate& p : pilot)
    mean += (p.radiosity.x + p.radiosity.y + p.radiosity.z) / (3.0 * double(pilot.size()));
  if (mean <= 0) return probes;
  for (size_t place = 0; place < probes.size(); ++place) {
    // A pilot may miss a narrow light; its neighbours along the curve will not all.
    double spread = 0;
    const size_t end = std::min(probes.size(), place + kNeighbours + 1);
    for (size_t i = place - std::min(place, kNeighbours); i < end; ++i)
      spread = std::max(spread, pilot[groups_.order[i]].spread);
    // The lattice's error falls about as n^-3/4.
    const double wanted = kPilotProbes + std::pow(spread / (noise * mean), 4.0 / 3.0);
    probes[groups_.order[place]] = int(std::min<double>(kMostProbes, wanted));
  }
  return probes;
}

}  // namespace lychnite
