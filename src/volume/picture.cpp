#include "volume/picture.h"

#include <tbb/parallel_for.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lychnite/optics/fresnel.h"
#include "reference/camera_receivers.h"
#include "reference/picture.h"
#include "reference/single_light.h"
#include "volume/gather.h"

namespace lychnite::volume {

namespace {

constexpr uint64_t kSinglePasses = 16;

/// Radiosity of all orders and radiance of order two and up at each receiver, times its weight.
struct ReceiverLight {
  glm::vec3 radiosity{0}, multiple{0};
};

std::vector<ReceiverLight> lightReceivers(const RayScene& rays, const World& world, const NodeLight& light,
                                          const CameraReceivers& receivers) {
  std::vector<ReceiverLight> result(receivers.receivers.size());
  constexpr size_t kBlock = 1024;
  tbb::parallel_for(size_t(0), (result.size() + kBlock - 1) / kBlock, [&](size_t b) {
    std::vector<Gather::Weight> weights;
    for (size_t i = b * kBlock; i < std::min(result.size(), (b + 1) * kBlock); ++i) {
      const Receiver& r = receivers.receivers[i];
      const auto object = size_t(r.hit.object);
      if (rays.opaque(r.hit.object)) continue;
      const Body& body = *world.bodies[object];
      const Surface& surface = body.shape->surface;
      const uint32_t cell = surface.samples()[surface.sampleAt(r.hit.triangle, r.hit.u, r.hit.v)].cell;
      Gather::weigh(*body.shape, body.toLocal(r.hit.position), body.turnBack * r.normal, cell, weights);
      const double cosO = glm::clamp(double(glm::dot(r.normal, r.view)), 0.0, 1.0);
      const auto lobe = float(exitLobe(cosO, double(body.medium.eta)));
      result[i].radiosity = r.weight * mean(weights, light.all[object]);
      result[i].multiple = r.weight * lobe * mean(weights, light.multiple[object]);
    }
  });
  return result;
}

std::vector<glm::vec3> singlePart(const RayScene& rays, const CameraReceivers& receivers, uint64_t seed,
                                  const Progress& progress) {
  const SingleLight single(rays, receivers);
  std::vector<glm::vec3> sum(receivers.covered.size(), glm::vec3(0));
  for (uint64_t pass = 0; pass < kSinglePasses; ++pass) {
    progress.check({"single scattering", double(pass) / double(kSinglePasses), ""});
    single.pass(pass, seed, -1, sum);
  }
  for (glm::vec3& s : sum) s /= float(kSinglePasses);
  return sum;
}

}  // namespace

Image volumePicture(const RayScene& rays, const World& world, const NodeLight& light,
                    const RenderSettings& settings, const Progress& progress) {
  const CameraReceivers receivers = findReceivers(rays, settings.width, settings.height);
  const size_t pixels = receivers.covered.size();
  PictureParts parts;
  std::vector<glm::vec3> radiosity(pixels, glm::vec3(0));
  if (settings.components.multiple || settings.wants("radiosity")) {
    const auto each = lightReceivers(rays, world, light, receivers);
    parts.multiple.assign(pixels, glm::vec3(0));
    for (size_t i = 0; i < each.size(); ++i) {
      radiosity[receivers.receivers[i].pixel] += each[i].radiosity;
      parts.multiple[receivers.receivers[i].pixel] += each[i].multiple;
    }
    if (!settings.components.multiple) parts.multiple.clear();
  }
  if (settings.components.single) parts.single = singlePart(rays, receivers, settings.seed, progress);
  if (settings.components.surface) parts.surface = surfacePart(rays, receivers);
  Image image = assemblePicture(rays, receivers, settings, parts);
  if (settings.wants("radiosity")) addLayer(image, "radiosity", radiosity);
  return image;
}

}  // namespace lychnite::volume
