#include "reference/dipole.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "reference/dipole_shells.h"

namespace lychnite {
namespace {

constexpr size_t kFirst = 32768;           ///< samples of the outermost shell
constexpr size_t kMost = 4 * 1024 * 1024;  ///< of the finest one before refinement
constexpr size_t kMostEach = 256;          ///< of these for each receiver: a few are cheaper to probe about
constexpr int kMostRefine = 16;
constexpr double kProbeNoise = 0.02;  ///< of one receiver, before refinement

/// One part of an object's radiosity, twice and independently.
struct Halves {
  int refine = 1;
  bool done = false;
  std::vector<Rgb> half[2];
};

/// One object's sums and what they are made with.
struct ObjectSums {
  std::vector<uint32_t> receivers;  ///< into CameraReceivers
  std::unique_ptr<Profile> profile;
  std::unique_ptr<DipoleShells> shells;
  std::unique_ptr<ShellPlan> plan;
  std::vector<int> probes;
  std::array<Halves, 2> parts;  ///< shells, near field

  Rgb at(size_t receiver, int half) const {
    return parts[0].half[half][receiver] + parts[1].half[half][receiver];
  }
};

ObjectSums makeSums(const RayScene& scene, const CameraReceivers& camera, const RenderSettings& settings,
                    int object, const DiffusionPart& part, const Progress& progress) {
  ObjectSums sums;
  ObjectReceivers own = receiversOf(camera, object);
  if (own.index.empty()) return sums;
  sums.receivers = std::move(own.index);
  sums.profile = makeProfile(part.profiles, {settings.profile, scene.medium(object), part.orders}, progress);
  sums.shells = std::make_unique<DipoleShells>(scene, object, *sums.profile, std::move(own.hits), part.light);
  const size_t most = std::min(kMost, kMostEach * sums.receivers.size());
  sums.plan = std::make_unique<ShellPlan>(sums.shells->sampler(), *sums.profile, kFirst, most);
  sums.probes = sums.shells->planProbes(*sums.plan, kProbeNoise, settings.seed * 977 + uint64_t(object));
  return sums;
}

/// Relative RMSE of the means of the halves as these tell it, over all receivers and channels together: of
/// the whole sum, and of each part.
struct Errors {
  double total = 0;
  std::array<double, 2> parts{};
};

Errors estimateErrors(const std::vector<ObjectSums>& objects, const CameraReceivers& camera) {
  double total = 0, shells = 0, near = 0, sum = 0, weights = 0;
  for (const ObjectSums& object : objects)
    for (size_t i = 0; i < object.receivers.size(); ++i) {
      const double weight = camera.receivers[object.receivers[i]].weight;
      const Rgb far = object.parts[0].half[0][i] - object.parts[0].half[1][i];
      const Rgb close = object.parts[1].half[0][i] - object.parts[1].half[1][i];
      const Rgb mean = 0.5 * (object.at(i, 0) + object.at(i, 1));
      total += weight * glm::dot(far + close, far + close);
      shells += weight * glm::dot(far, far);
      near += weight * glm::dot(close, close);
      sum += weight * (mean.x + mean.y + mean.z);
      weights += 3 * weight;
    }
  if (sum <= 0) return {};
  const auto relative = [&](double squares) { return 0.5 * std::sqrt(squares / weights) / (sum / weights); };
  return {relative(total), {relative(shells), relative(near)}};
}

/// Computes the parts that are not done. Returns with all done.
void sumMissing(std::vector<ObjectSums>& objects, uint64_t seed, const Tick& tick) {
  const double steps = 4.0 * double(objects.size());
  double step = 0;
  const Tick within = [&](double fraction) { tick((step + fraction) / steps); };
  for (ObjectSums& object : objects)
    for (size_t p = 0; p < 2; ++p)
      for (int half = 0; half < 2; ++half, ++step) {
        Halves& part = object.parts[p];
        if (part.done) continue;
        const uint64_t own = seed + uint64_t(step);
        part.half[half] = p == 0
                              ? object.shells->sumShells(*object.plan, part.refine, own, within)
                              : object.shells->sumNear(*object.plan, part.refine, object.probes, own, within);
        part.done = half == 1;
      }
}

/// Asks for more of the parts whose error is too large; false when nothing more can be done. The error falls
/// about as n^-3/4, and two parts share what is allowed.
bool refineParts(std::vector<ObjectSums>& objects, const Errors& errors, double tolerance) {
  bool any = false;
  for (size_t p = 0; p < 2; ++p) {
    const double excess = errors.parts[p] / (0.65 * tolerance);
    if (excess <= 1) continue;
    const double factor = std::clamp(std::pow(excess, 4.0 / 3.0), 2.0, 8.0);
    for (ObjectSums& object : objects) {
      Halves& part = object.parts[p];
      const int more = std::min(kMostRefine, int(std::ceil(part.refine * factor)));
      const bool gains =
          p == 0 ? object.plan->refined(more) > object.plan->refined(part.refine) : more > part.refine;
      if (!gains) continue;
      part.refine = more;
      part.done = false;
      any = true;
    }
  }
  return any;
}

}  // namespace

ObjectReceivers receiversOf(const CameraReceivers& receivers, int object) {
  ObjectReceivers own;
  for (uint32_t i = 0; i < receivers.receivers.size(); ++i) {
    if (receivers.receivers[i].hit.object != object) continue;
    own.index.push_back(i);
    own.hits.push_back(receivers.receivers[i].hit);
  }
  return own;
}

DiffusionSum sumDipole(const RayScene& scene, const CameraReceivers& receivers,
                       const RenderSettings& settings, const DiffusionPart& part, const Progress& progress) {
  DiffusionSum result;
  result.radiosity.assign(receivers.receivers.size(), glm::vec3(0));
  std::vector<ObjectSums> objects;
  for (size_t i = 0; i < scene.objectCount(); ++i) {
    if (scene.opaque(int(i))) continue;
    ObjectSums sums = makeSums(scene, receivers, settings, int(i), part, progress);
    if (!sums.receivers.empty()) objects.push_back(std::move(sums));
  }
  for (uint64_t pass = 0;; ++pass) {
    const std::string detail = pass ? fmt::format("{:.2g} %, refining", 100 * result.error) : "";
    const Tick tick = [&](double fraction) {
      progress.check({.what = "dipole", .fraction = fraction, .detail = detail});
    };
    sumMissing(objects, settings.seed * 131071 + pass * 1024, tick);
    const Errors errors = estimateErrors(objects, receivers);
    result.error = errors.total;
    if (result.error <= settings.tolerance || !refineParts(objects, errors, settings.tolerance)) break;
  }
  for (const ObjectSums& object : objects) {
    result.samples += 2 * object.plan->refined(object.parts[0].refine);
    for (size_t i = 0; i < object.receivers.size(); ++i)
      result.radiosity[object.receivers[i]] = glm::vec3(0.5 * (object.at(i, 0) + object.at(i, 1)));
  }
  return result;
}

}  // namespace lychnite
