#include "reference/hierarchical.h"

#include <algorithm>
#include <cmath>

#include "reference/dipole_kernel.h"
#include "reference/dipole_near_field.h"
#include "reference/dipole_shells.h"
#include "reference/octree.h"
#include "reference/surface_samples.h"

namespace lychnite {
namespace {

constexpr double kSpacing = 0.125;  ///< between samples, in mean free paths
constexpr size_t kFewest = 64 * 1024, kMost = 4 * 1024 * 1024;
constexpr size_t kMostEach = 2048, kMostOfFew = 128 * 1024;  ///< for each receiver, and for few receivers
constexpr double kNearReach = 12;                            ///< radius of the near field, in spacings
constexpr float kSolidAngle =
    0.05f;                     ///< largest of a node that stands for its samples, as seen from a receiver
constexpr size_t kGroup = 32;  ///< receivers that share a traversal
constexpr double kProbeNoise = 0.01;

/// Samples of an object for the stated spacing.
size_t sampleCount(const SurfaceSampler& sampler, const Coefficients& medium, size_t receivers) {
  const Rgb sigma_tp = medium.sigma_tp();
  const double spacing = kSpacing / std::max({sigma_tp.x, sigma_tp.y, sigma_tp.z, 1e-12});
  return size_t(std::clamp(sampler.area() / (spacing * spacing), double(kFewest),
                           double(std::clamp(kMostEach * receivers, kMostOfFew, kMost))));
}

/// Radiosity at the points of one object.
std::vector<Rgb> sumObject(const RayScene& scene, int object, const std::vector<RayHit>& receivers,
                           const RenderSettings& settings, const DiffusionPart& part, const Profile& profile,
                           size_t& samples, const Tick& tick) {
  const Coefficients medium = scene.medium(object);
  const PointGroups groups(positionsOf(receivers), kGroup);
  const SurfaceSampler sampler(scene.mesh(object));
  samples = sampleCount(sampler, medium, receivers.size());
  FluxPoints sources = litSamples(scene, object, sampler, samples, settings.seed, part.light);
  const double reach = longestDistance(groups, sources);
  const FluxOctree tree(std::move(sources), sampler.area() / double(samples));
  const bool near = !resolves(profile, sampler.spacing(samples));
  const double nearRadius = near ? kNearReach * sampler.spacing(samples) : 0;
  const KernelTable kernel(profile, nearRadius, 0, reach);
  std::vector<Rgb> sums(receivers.size(), Rgb(0));
  forGroups(
      groups, [&](double f) { tick(near ? 0.5 * f : f); },
      [&](const PointGroups::Group& group) {
        FluxPoints list;
        tree.gather(group.box, kSolidAngle, list);
        for (uint32_t i = group.begin; i < group.end; ++i) {
          const uint32_t r = groups.order[i];
          sums[r] += sumKernel(kernel, receivers[r].position, list, 0, list.size());
        }
      });
  if (near) {
    const NearField field(scene, object, profile, nearRadius, part.light);
    const std::vector<int> probes = field.planProbes(receivers, groups, kProbeNoise, settings.seed * 2 + 1);
    field.add(
        receivers, groups, probes, 1, settings.seed * 2, [&](double f) { tick(0.5 + 0.5 * f); }, sums);
  }
  return sums;
}

}  // namespace

DiffusionSum sumHierarchical(const RayScene& scene, const CameraReceivers& receivers,
                             const RenderSettings& settings, const DiffusionPart& part,
                             const Progress& progress) {
  DiffusionSum result;
  result.radiosity.assign(receivers.receivers.size(), glm::vec3(0));
  const double objects = double(scene.objectCount());
  for (size_t object = 0; object < scene.objectCount(); ++object) {
    if (scene.opaque(int(object))) continue;
    const ObjectReceivers own = receiversOf(receivers, int(object));
    if (own.index.empty()) continue;
    const Tick tick = [&](double fraction) {
      progress.check(
          {.what = "hierarchical", .fraction = (double(object) + fraction) / objects, .detail = ""});
    };
    const auto profile =
        makeProfile(part.profiles, {settings.profile, scene.medium(int(object)), part.orders}, progress);
    size_t samples = 0;
    const std::vector<Rgb> sums =
        sumObject(scene, int(object), own.hits, settings, part, *profile, samples, tick);
    result.samples += samples;
    for (size_t i = 0; i < own.index.size(); ++i) result.radiosity[own.index[i]] = glm::vec3(sums[i]);
  }
  return result;
}

}  // namespace lychnite
