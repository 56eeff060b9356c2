#include "volume/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec2.hpp>

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

/// What leaves where it enters, in detail finer than nodes.
struct FineLight {
  glm::vec3 radiosity{0}, multiple{0};
};

/// Each spot's part is what enters there times the body's share. For a preview of a pixel that sees one
/// object one spot near the middle stands for all.
FineLight fineLight(const RayScene& rays, const NodeLight& light, std::span<const View::Spot> spots,
                    bool preview) {
  FineLight result;
  if (spots.empty()) return result;
  const auto alike = [&](const View::Spot& spot) { return spot.object == spots.front().object; };
  const bool one = preview && std::all_of(spots.begin(), spots.end(), alike);
  const auto looks = one ? spots.subspan(spots.size() * 5 / 8, 1) : spots;
  glm::vec2 all(0), seen(0);  // of the weights
  for (const View::Spot& spot : spots) all += glm::vec2(spot.radiosity, spot.radiance);
  for (const View::Spot& spot : looks) {
    seen += glm::vec2(spot.radiosity, spot.radiance);
    const glm::vec3 &a = light.fineAll[spot.object], &m = light.fineMultiple[spot.object];
    if (a == glm::vec3(0) && m == glm::vec3(0)) continue;
    const glm::vec3 E(enteringIrradiance(rays, double(rays.medium(int(spot.object)).eta), spot.point, -1));
    result.radiosity += spot.radiosity * a * E;
    result.multiple += spot.radiance * m * E;
  }
  const glm::vec2 scale = all / glm::max(seen, glm::vec2(1e-20f));
  return {result.radiosity * scale.x, result.multiple * scale.y};
}

PixelLight lightPixels(const RayScene& rays, const World& world, const NodeLight& light, View& view,
                       bool preview) {
  const std::vector<Lanes> all = inOneRow(world, light.all), multiple = inOneRow(world, light.multiple),
                           error = inOneRow(world, light.error);
  const std::vector<glm::vec3> dark(view.receivers().covered.size(), glm::vec3(0));
  PixelLight result{dark, dark, dark};
  const auto sumUp = [](std::span<const View::Share> shares, const std::vector<Lanes>& flux,
                        float View::Share::*part) {
    Lanes sum{0, 0, 0, 0};
    if (!flux.empty())
      for (const View::Share& share : shares) sum += share.*part * flux[share.node];
    return glm::vec3(sum[0], sum[1], sum[2]);
  };
  view.forPixels([&](const View::Pixel& pixel) {
    const FineLight fine = fineLight(rays, light, pixel.spots, preview);
    const glm::vec3 none(0);
    result.radiosity[pixel.index] =
        glm::max(sumUp(pixel.shares, all, &View::Share::radiosity) + fine.radiosity, none);
    result.multiple[pixel.index] =
        glm::max(sumUp(pixel.shares, multiple, &View::Share::radiance) + fine.multiple, none);
    result.error[pixel.index] = sumUp(pixel.shares, error, &View::Share::radiance);
  });
  return result;
}

}  // namespace

Image volumePicture(const RayScene& rays, const World& world, const NodeLight& light, View& view,
                    const std::vector<glm::vec3>& single, const RenderSettings& settings, bool preview,
                    const Progress& progress) {
  const Interruptible inside(progress, {"volume: picture", 0, ""});
  const CameraReceivers& receivers = view.receivers();
  PictureParts parts;
  PixelLight pixels;
  if (settings.components.multiple || settings.wants("radiosity") || settings.wants("stderr"))
    pixels = lightPixels(rays, world, light, view, preview);
  if (settings.components.multiple) parts.multiple = std::move(pixels.multiple);
  parts.single = single;
  if (settings.components.surface) parts.surface = surfacePart(rays, receivers);
  Image image = assemblePicture(rays, receivers, settings, parts);
  if (settings.wants("radiosity")) addLayer(image, "radiosity", pixels.radiosity);
  if (settings.wants("stderr")) addLayer(image, "stderr", pixels.error);
  return image;
}

void tellStats(const VolumeStats& stats, Image& image) {
  const auto put = [&](const char* key, const std::string& value) {
    image.metadata[std::string("volume.") + key] = value;
  };
  const auto rgb = [](const Rgb& c) { return fmt::format("{:.6g} {:.6g} {:.6g}", c.x, c.y, c.z); };
  put("geometry_ms", fmt::format("{:.1f}", stats.geometryMs));
  put("source_ms", fmt::format("{:.1f}", stats.sourceMs));
  put("solve_ms", fmt::format("{:.1f}", stats.solveMs));
  put("exchange_ms", fmt::format("{:.1f}", stats.exchangeMs));
  put("cells", fmt::format("{}", stats.cells));
  put("memory_bytes", fmt::format("{}", stats.memoryBytes));
  put("passes", fmt::format("{}", stats.passes));
  put("iterations", fmt::format("{}", stats.iterations));
  put("left", rgb(stats.left));
  put("absorbed", rgb(stats.absorbed));
  put("unscattered", rgb(stats.unscattered));
  put("lost", rgb(stats.lost));
}

}  // namespace lychnite::volume
