#include "reference/dipole.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reference/dipole_shells.h"

namespace lychnite {
namespace {

constexpr size_t kFirst = 32768;           ///< samples of the outermost shell
constexpr size_t kMost = 4 * 1024 * 1024;  ///< of the finest one before refinement
constexpr int kMostRefine = 16;
constexpr double kProbeNoise = 0.02;

/// Two independent sums over one object, and what is known of it.
struct ObjectSums {
  std::unique_ptr<Profile> profile;
  std::unique_ptr<DipoleShells> shells;
  std::vector<uint32_t> receivers;  ///< into CameraReceivers
  std::vector<int> probes;
  std::vector<Rgb> half[2];
  std::unique_ptr<ShellPlan> plan;
};

ObjectSums makeSums(const RayScene& scene, const CameraReceivers& camera, const RenderSettings& settings,
                    int object, int light) {
  ObjectSums sums;
  std::vector<RayHit> hits;
  for (uint32_t i = 0; i < camera.receivers.size(); ++i)
    if (camera.receivers[i].hit.object == object) {
      sums.receivers.push_back(i);
      hits.push_back(camera.receivers[i].hit);
    }
  if (hits.empty()) return sums;
  sums.profile = makeProfile(settings.profile, scene.medium(object));
  sums.shells = std::make_unique<DipoleShells>(scene, object, *sums.profile, std::move(hits), light);
  sums.plan = std::make_unique<ShellPlan>(sums.shells->sampler(), *sums.profile, kFirst, kMost);
  sums.probes = sums.shells->planProbes(*sums.plan, kProbeNoise, settings.seed * 977 + uint64_t(object));
  return sums;
}

/// Estimated relative RMSE of the means of the halves, over all receivers and channels together.
double estimateError(const std::vector<ObjectSums>& objects, const CameraReceivers& camera) {
  double squares = 0, mean = 0, weights = 0;
  for (const ObjectSums& object : objects)
    for (size_t i = 0; i < object.receivers.size(); ++i) {
      const double weight = camera.receivers[object.receivers[i]].weight;
      const Rgb difference = object.half[0][i] - object.half[1][i],
                sum = object.half[0][i] + object.half[1][i];
      squares += weight * glm::dot(difference, difference) / 4;
      mean += weight * (sum.x + sum.y + sum.z) / 2;
      weights += 3 * weight;
    }
  return mean > 0 ? std::sqrt(squares / weights) / (mean / weights) : 0;
}

/// How much finer to sample for an error to come below the wanted one, if it falls as n^-3/4.
int nextRefinement(int refine, double error, double wanted) {
  const double factor = std::clamp(std::pow(error / wanted, 4.0 / 3.0), 2.0, 8.0);
  return std::min(kMostRefine, int(std::ceil(refine * factor)));
}

}  // namespace

DiffusionSum sumDipole(const RayScene& scene, const CameraReceivers& receivers,
                       const RenderSettings& settings, int light, const Progress& progress) {
  DiffusionSum result;
  result.radiosity.assign(receivers.receivers.size(), glm::vec3(0));
  std::vector<ObjectSums> objects;
  for (size_t i = 0; i < scene.objectCount(); ++i) {
    if (scene.opaque(int(i))) continue;
    ObjectSums sums = makeSums(scene, receivers, settings, int(i), light);
    if (!sums.receivers.empty()) objects.push_back(std::move(sums));
  }
  for (int refine = 1, pass = 0;; ++pass) {
    for (size_t i = 0; i < objects.size(); ++i)
      for (int half = 0; half < 2; ++half) {
        const double parts = 2.0 * double(objects.size()), part = double(2 * i) + half;
        const Tick tick = [&](double fraction) {
          const std::string detail =
              pass ? fmt::format("refining to {:.2g} %", 100 * settings.tolerance) : "";
          progress.check({.what = "dipole", .fraction = (part + fraction) / parts, .detail = detail});
        };
        const uint64_t seed = settings.seed * 131071 + uint64_t(pass) * 4096 + i * 2 + uint64_t(half);
        objects[i].half[half] =
            objects[i].shells->sum(*objects[i].plan, refine, objects[i].probes, seed, tick);
      }
    result.error = estimateError(objects, receivers);
    if (result.error <= settings.tolerance || refine >= kMostRefine) {
      for (const ObjectSums& object : objects) result.samples += 2 * object.plan->samples * size_t(refine);
      break;
    }
    refine = nextRefinement(refine, result.error, settings.tolerance);
  }
  for (const ObjectSums& object : objects)
    for (size_t i = 0; i < object.receivers.size(); ++i)
      result.radiosity[object.receivers[i]] = glm::vec3(0.5 * (object.half[0][i] + object.half[1][i]));
  return result;
}

}  // namespace lychnite
