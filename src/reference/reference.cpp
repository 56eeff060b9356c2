#include "lychnite/reference/reference.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>

#include "lychnite/base/error.h"
#include "lychnite/optics/fresnel.h"
#include "reference/camera_receivers.h"
#include "reference/dipole.h"
#include "reference/hierarchical.h"
#include "reference/picture.h"
#include "reference/single_light.h"
#include "reference/walk.h"

namespace lychnite {

namespace {

constexpr uint64_t kSinglePasses = 32;

/// Radiance of the receivers' radiosities by S_w; with `lobe` false the radiosities themselves.
std::vector<glm::vec3> gathered(const RayScene& rays, const CameraReceivers& receivers,
                                const std::vector<glm::vec3>& radiosity, bool lobe) {
  std::vector<glm::vec3> values(receivers.covered.size(), glm::vec3(0));
  for (size_t i = 0; i < radiosity.size(); ++i) {
    const Receiver& r = receivers.receivers[i];
    if (rays.opaque(r.hit.object)) continue;
    const double cosO = glm::clamp(double(glm::dot(r.normal, r.view)), 0.0, 1.0);
    const double eta = rays.scene().objects[size_t(r.hit.object)].material.medium.eta;
    values[r.pixel] += radiosity[i] * (r.weight * (lobe ? float(exitLobe(cosO, eta)) : 1.0f));
  }
  return values;
}

DiffusionSum sumDiffusion(const RayScene& rays, const CameraReceivers& receivers,
                          const RenderSettings& settings, const DiffusionPart& part,
                          const Progress& progress) {
  return settings.method == Method::kDipole ? sumDipole(rays, receivers, settings, part, progress)
                                            : sumHierarchical(rays, receivers, settings, part, progress);
}

/// The estimate may have stopped above what was asked for, because more samples are not to be had.
void warnAboveTolerance(const DiffusionSum& sum, const RenderSettings& settings, const LogSink& log) {
  if (settings.method != Method::kDipole || sum.error <= settings.tolerance) return;
  logTo(log, LogLevel::kWarning,
        fmt::format(
            "dipole: stopped at an estimated error of {:.2g} %, above the tolerance of {:.2g} %, where its "
            "samples are at their bounds",
            100 * sum.error, 100 * settings.tolerance));
}

/// A picture of a method that sums a diffusion profile over the surface.
Image renderDiffusion(const RayScene& rays, const CameraReceivers& receivers, const RenderSettings& settings,
                      const ProfileMaker& profiles, const Progress& progress, const LogSink& log) {
  const auto start = std::chrono::steady_clock::now();
  PictureParts parts;
  DiffusionSum sum, whole;
  const bool wantsWhole = settings.wants("radiosity"), apart = tellsOrdersApart(settings.profile);
  const auto summed = [&](ProfileOrders orders) {
    const DiffusionPart part{.profiles = profiles, .orders = orders};
    DiffusionSum result = sumDiffusion(rays, receivers, settings, part, progress);
    warnAboveTolerance(result, settings, log);
    return result;
  };
  if (settings.components.multiple || (wantsWhole && !apart)) sum = summed(ProfileOrders::kFromSecond);
  if (settings.components.multiple) parts.multiple = gathered(rays, receivers, sum.radiosity, true);
  if (wantsWhole && apart) whole = summed(ProfileOrders::kAll);
  if (settings.components.single)
    parts.single = SingleLight(rays, receivers).mean(kSinglePasses, settings.seed, progress);
  if (settings.components.surface) parts.surface = surfacePart(rays, receivers);
  Image image = assemblePicture(rays, receivers, settings, parts);
  if (settings.wants("radiosity"))
    addLayer(image, "radiosity", gathered(rays, receivers, (apart ? whole : sum).radiosity, false));
  image.metadata["profile"] = profileName(settings.profile);
  image.metadata["surface_samples"] = fmt::format("{}", std::max(sum.samples, whole.samples));
  if (settings.method == Method::kDipole)
    image.metadata["estimated_error"] = fmt::format("{:.6g}", std::max(sum.error, whole.error));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  image.metadata["seconds"] = fmt::format("{:.3f}", seconds.count());
  return image;
}

}  // namespace

Image renderReference(const Scene& scene, const RenderSettings& settings, const Progress& progress,
                      const LogSink& log, const ReferenceOptions& options) {
  validate(scene);
  validate(settings);
  if (!isReference(settings.method))
    throw Error({.where = "method",
                 .expected = "dipole, hierarchical or walk",
                 .found = "'" + methodName(settings.method) + "'",
                 .todo = "render it with the real-time Renderer"},
                Error::Kind::kUsage);
  tbb::task_arena arena(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic);
  return arena.execute([&] {
    const RayScene rays(scene);
    const CameraReceivers receivers = findReceivers(rays, settings.width, settings.height);
    if (settings.method == Method::kWalk)
      return renderWalk(rays, receivers, settings, options, progress, log);
    return renderDiffusion(rays, receivers, settings, options.profiles, progress, log);
  });
}

}  // namespace lychnite
