#include "volume/picture.h"

#include <glm/common.hpp>

#include "reference/picture.h"
#include "volume/interruptible.h"

namespace lychnite::volume {

namespace {

/// Radiosity of all orders, radiance of order two and up and its standard error, means over a pixel; one
/// entry a pixel.
struct PixelLight {
  std::vector<glm::vec3> radiosity, multiple, error;
};

/// All bodies' nodes in one row; empty where no body has any light.
std::vector<Lanes> inOneRow(const World& world, const std::vector<std::vector<Lanes>>& each) {
  std::vector<Lanes> all;
  bool any = false;
  for (size_t i = 0; i < each.size(); ++i) {
    if (!world.bodies[i]) continue;
    any = any || !each[i].empty();
    all.insert(all.end(), each[i].begin(), each[i].end());
    if (each[i].empty()) all.resize(all.size() + world.bodies[i]->shape->surface.nodes().size(), Lanes{});
  }
  if (!any) all.clear();
  return all;
}

PixelLight lightPixels(const World& world, const NodeLight& light, View& view) {
  const std::vector<Lanes> all = inOneRow(world, light.all), multiple = inOneRow(world, light.multiple),
                           error = inOneRow(world, light.error);
  const std::vector<glm::vec3> none(view.receivers().covered.size(), glm::vec3(0));
  PixelLight result{none, none, none};
  const auto sumUp = [](std::span<const View::Share> shares, const std::vector<Lanes>& flux,
                        float View::Share::*part) {
    Lanes sum{0, 0, 0, 0};
    if (!flux.empty())
      for (const View::Share& share : shares) sum += share.*part * flux[share.node];
    return glm::max(glm::vec3(sum[0], sum[1], sum[2]), glm::vec3(0));
  };
  view.forPixels([&](uint32_t pixel, std::span<const View::Share> shares) {
    result.radiosity[pixel] = sumUp(shares, all, &View::Share::radiosity);
    result.multiple[pixel] = sumUp(shares, multiple, &View::Share::radiance);
    result.error[pixel] = sumUp(shares, error, &View::Share::radiance);
  });
  return result;
}

}  // namespace

Image volumePicture(const RayScene& rays, const World& world, const NodeLight& light, View& view,
                    const std::vector<glm::vec3>& single, const RenderSettings& settings,
                    const Progress& progress) {
  const Interruptible inside(progress, {"volume: picture", 0, ""});
  const CameraReceivers& receivers = view.receivers();
  PictureParts parts;
  PixelLight pixels;
  if (settings.components.multiple || settings.wants("radiosity") || settings.wants("stderr"))
    pixels = lightPixels(world, light, view);
  if (settings.components.multiple) parts.multiple = std::move(pixels.multiple);
  parts.single = single;
  if (settings.components.surface) parts.surface = surfacePart(rays, receivers);
  Image image = assemblePicture(rays, receivers, settings, parts);
  if (settings.wants("radiosity")) addLayer(image, "radiosity", pixels.radiosity);
  if (settings.wants("stderr")) addLayer(image, "stderr", pixels.error);
  return image;
}

}  // namespace lychnite::volume
