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

/// Radiosity of all orders and radiance of order two and up, means over a pixel.
struct PixelLight {
  glm::vec3 radiosity{0}, multiple{0};
};

/// Looks up the light of pixels. Where a surface turns away from the eye or ends, a pixel spans much of it:
/// a raster of rays stands for it there, so that the mean is over area, as that of the walk's splats.
class Looker {
 public:
  Looker(const RayScene& rays, const World& world, const NodeLight& light, const CameraReceivers& receivers)
      : rays_(rays), world_(world), light_(light), camera_(rays.camera(receivers.width, receivers.height)) {}

  /// The receivers of one pixel.
  PixelLight look(const Receiver* begin, const Receiver* end) {
    if (end - begin == 1 && begin->weight == 1 && glm::dot(begin->normal, begin->view) > kSteep)
      return at(begin->hit, begin->normal, begin->view);
    const int column = int(begin->pixel) % camera_.width, row = int(begin->pixel) / camera_.width;
    PixelLight sum;
    for (int j = 0; j < kRaster; ++j)
      for (int i = 0; i < kRaster; ++i) {
        const glm::dvec3 direction =
            camera_.direction(column + (i + 0.5) / kRaster, row + (j + 0.5) / kRaster);
        const RayHit hit = rays_.nearest(glm::vec3(camera_.position), glm::vec3(direction));
        if (!hit) continue;
        const glm::vec3 view(-direction);
        glm::vec3 normal = rays_.mesh(hit.object).shadingNormal(hit);
        if (glm::dot(normal, view) < 1e-3f) normal = hit.normal;
        const PixelLight one = at(hit, normal, view);
        sum.radiosity += one.radiosity;
        sum.multiple += one.multiple;
      }
    constexpr float kEach = 1.0f / (kRaster * kRaster);
    return {sum.radiosity * kEach, sum.multiple * kEach};
  }

 private:
  static constexpr float kSteep = 0.45f;  // cosine to the eye
  static constexpr int kRaster = 4;

  PixelLight at(const RayHit& hit, const glm::vec3& normal, const glm::vec3& view) {
    if (rays_.opaque(hit.object)) return {};
    const auto object = size_t(hit.object);
    const Body& body = *world_.bodies[object];
    const Surface& surface = body.shape->surface;
    const uint32_t cell = surface.samples()[surface.sampleAt(hit.triangle, hit.u, hit.v)].cell;
    Gather::weigh(*body.shape, body.toLocal(hit.position), body.turnBack * normal, cell, weights_);
    const double cosO = glm::clamp(double(glm::dot(normal, view)), 0.0, 1.0);
    const auto lobe = float(exitLobe(cosO, double(body.medium.eta)));
    return {mean(weights_, light_.all[object]), lobe * mean(weights_, light_.multiple[object])};
  }

  const RayScene& rays_;
  const World& world_;
  const NodeLight& light_;
  CameraFrame camera_;
  std::vector<Gather::Weight> weights_;
};

/// One entry a pixel.
std::vector<PixelLight> lightPixels(const RayScene& rays, const World& world, const NodeLight& light,
                                    const CameraReceivers& receivers) {
  const std::vector<Receiver>& all = receivers.receivers;
  std::vector<PixelLight> result(receivers.covered.size());
  std::vector<size_t> first;  // receivers of a pixel follow each other
  for (size_t i = 0; i < all.size(); ++i)
    if (i == 0 || all[i].pixel != all[i - 1].pixel) first.push_back(i);
  first.push_back(all.size());
  constexpr size_t kBlock = 1024;
  tbb::parallel_for(size_t(0), (first.size() - 1 + kBlock - 1) / kBlock, [&](size_t b) {
    Looker looker(rays, world, light, receivers);
    for (size_t i = b * kBlock; i < std::min(first.size() - 1, (b + 1) * kBlock); ++i)
      result[all[first[i]].pixel] = looker.look(all.data() + first[i], all.data() + first[i + 1]);
  });
  return result;
}

}  // namespace

Image volumePicture(const RayScene& rays, const World& world, const NodeLight& light,
                    const RenderSettings& settings, const Progress& progress) {
  const CameraReceivers receivers = findReceivers(rays, settings.width, settings.height);
  const size_t pixels = receivers.covered.size();
  PictureParts parts;
  std::vector<glm::vec3> radiosity(pixels, glm::vec3(0));
  if (settings.components.multiple || settings.wants("radiosity")) {
    const auto each = lightPixels(rays, world, light, receivers);
    parts.multiple.assign(pixels, glm::vec3(0));
    for (size_t i = 0; i < each.size(); ++i) {
      radiosity[i] = each[i].radiosity;
      parts.multiple[i] = each[i].multiple;
    }
    if (!settings.components.multiple) parts.multiple.clear();
  }
  if (settings.components.single)
    parts.single = singlePart(rays, receivers, kSinglePasses, settings.seed, progress);
  if (settings.components.surface) parts.surface = surfacePart(rays, receivers);
  Image image = assemblePicture(rays, receivers, settings, parts);
  if (settings.wants("radiosity")) addLayer(image, "radiosity", radiosity);
  return image;
}

}  // namespace lychnite::volume
