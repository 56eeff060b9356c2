#include "volume/picture.h"

#include <tbb/parallel_for.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lychnite/optics/fresnel.h"
#include "reference/camera_receivers.h"
#include "reference/picture.h"
#include "reference/single_light.h"
#include "volume/gather.h"
#include "volume/interruptible.h"

namespace lychnite::volume {

namespace {

constexpr uint64_t kSinglePasses = 16;

/// Radiosity of all orders, radiance of order two and up and its standard error, means over a pixel.
struct PixelLight {
  glm::vec3 radiosity{0}, multiple{0}, error{0};
  void add(const PixelLight& other, float share) {
    radiosity += other.radiosity * share;
    multiple += other.multiple * share;
    error += other.error * share;
  }
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
      for (int i = 0; i < kRaster; ++i) addPart(column, row, i, j, sum);
    return sum;
  }

 private:
  static constexpr float kSteep = 0.45f;  // cosine to the eye
  static constexpr int kRaster = 4;       // parts of a pixel each way, one look at the light each
  static constexpr int kCoverage = 2;     // rays of a part each way, that tell how much of it is covered

  /// Part (i, j) of a pixel, weighted by its share.
  void addPart(int column, int row, int i, int j, PixelLight& sum) {
    constexpr int kSide = kRaster * kCoverage, kRays = kCoverage * kCoverage;
    RayHit middle;
    glm::vec3 view(0);
    int hits = 0;
    for (int n = 0; n < kRays; ++n) {
      const double x = (i * kCoverage + n % kCoverage + 0.5) / kSide;
      const double y = (j * kCoverage + n / kCoverage + 0.5) / kSide;
      const glm::vec3 direction(camera_.direction(column + x, row + y));
      const RayHit hit = rays_.nearest(glm::vec3(camera_.position), direction);
      if (!hit) continue;
      // One of them stands for all, another one in each part, so that no side is preferred.
      if (hits == 0 || n == (i + 2 * j) % kRays) middle = hit, view = -direction;
      ++hits;
    }
    if (hits == 0) return;
    glm::vec3 normal = rays_.mesh(middle.object).shadingNormal(middle);
    if (glm::dot(normal, view) < 1e-3f) normal = middle.normal;
    sum.add(at(middle, normal, view), float(hits) / (kSide * kSide));
  }

  PixelLight at(const RayHit& hit, const glm::vec3& normal, const glm::vec3& view) {
    if (rays_.opaque(hit.object)) return {};
    const auto object = size_t(hit.object);
    const Body& body = *world_.bodies[object];
    const Surface& surface = body.shape->surface;
    const uint32_t cell = surface.samples()[surface.sampleAt(hit.triangle, hit.u, hit.v)].cell;
    Gather::weigh(*body.shape, body.toLocal(hit.position), body.turnBack * normal, cell, weights_);
    const double cosO = glm::clamp(double(glm::dot(normal, view)), 0.0, 1.0);
    const auto lobe = float(exitLobe(cosO, double(body.medium.eta)));
    const auto meanOf = [&](const std::vector<std::vector<Lanes>>& part) {
      return part[object].empty() ? glm::vec3(0) : glm::max(mean(weights_, part[object]), glm::vec3(0));
    };
    return {meanOf(light_.all), lobe * meanOf(light_.multiple), lobe * meanOf(light_.error)};
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
    Interruptible::check();
    Looker looker(rays, world, light, receivers);
    for (size_t i = b * kBlock; i < std::min(first.size() - 1, (b + 1) * kBlock); ++i)
      result[all[first[i]].pixel] = looker.look(all.data() + first[i], all.data() + first[i + 1]);
  });
  return result;
}

}  // namespace

Image volumePicture(const RayScene& rays, const World& world, const NodeLight& light,
                    const RenderSettings& settings, const Progress& progress) {
  const Interruptible inside(progress, {"volume: picture", 0, ""});
  const CameraReceivers receivers = findReceivers(rays, settings.width, settings.height);
  const size_t pixels = receivers.covered.size();
  PictureParts parts;
  std::vector<glm::vec3> radiosity(pixels, glm::vec3(0)), error = radiosity;
  if (settings.components.multiple || settings.wants("radiosity") || settings.wants("stderr")) {
    const auto each = lightPixels(rays, world, light, receivers);
    parts.multiple.assign(pixels, glm::vec3(0));
    for (size_t i = 0; i < each.size(); ++i) {
      radiosity[i] = each[i].radiosity;
      parts.multiple[i] = each[i].multiple;
      error[i] = each[i].error;
    }
    if (!settings.components.multiple) parts.multiple.clear();
  }
  if (settings.components.single)
    parts.single = singlePart(rays, receivers, kSinglePasses, settings.seed, progress);
  if (settings.components.surface) parts.surface = surfacePart(rays, receivers);
  Image image = assemblePicture(rays, receivers, settings, parts);
  if (settings.wants("radiosity")) addLayer(image, "radiosity", radiosity);
  if (settings.wants("stderr")) addLayer(image, "stderr", error);
  return image;
}

}  // namespace lychnite::volume
