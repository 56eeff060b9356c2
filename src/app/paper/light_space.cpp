#include "app/paper/light_space.h"

#include <algorithm>
#include <cmath>

#include "technique/renderer_textures.h"

namespace lychnite::paper {
namespace {

constexpr float kDark = 1e-4f;  // a texel with less flux shows no surface

}  // namespace

FluxMap::FluxMap(Renderer& renderer, const Scene& scene, int size) : size_(size) {
  RenderSettings settings;
  settings.width = settings.height = 16;
  settings.mapSize = settings.mostMapSize = size;
  settings.components = {.multiple = true, .single = false, .surface = false};
  renderer.draw(scene, settings);
  const LightMapPass::Map& map = RendererTextures::maps(renderer).get(0, 0);
  const double unit = scene.objects[0].size;  // of the renderer: the largest translucent object
  texel_ = 2 * map.view.halfWidth * unit / size;
  const std::vector<float> moments = map.moments->download();
  levels_.emplace_back();
  for (size_t i = 0; i < moments.size(); i += 4) levels_[0].push_back(moments[i]);
  for (int side = size / 2; side > 0; side /= 2) {
    const std::vector<float>& finer = levels_.back();
    std::vector<float> coarser(size_t(side) * size_t(side));
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const size_t at = size_t(2 * y) * size_t(2 * side) + size_t(2 * x), up = at + size_t(2 * side);
        coarser[size_t(y) * size_t(side) + size_t(x)] =
            0.25f * (finer[at] + finer[at + 1] + finer[up] + finer[up + 1]);
      }
    levels_.push_back(std::move(coarser));
  }
}

double FluxMap::mean(const glm::dvec2& place, int level) const {
  const int n = std::clamp(level, 0, int(levels_.size()) - 1), side = size_ >> n;
  const int x = int(std::floor(place.x / (1 << n))), y = int(std::floor(place.y / (1 << n)));
  if (x < 0 || y < 0 || x >= side || y >= side) return 0;
  return double(levels_[size_t(n)][size_t(y) * size_t(side) + size_t(x)]);
}

Image FluxMap::picture() const {
  Image image(size_, size_);
  for (const char* channel : {"R", "G", "B"}) image.addChannel(channel);
  for (int y = 0; y < size_; ++y)
    for (int x = 0; x < size_; ++x) {
      const float flux = levels_[0][size_t(size_ - 1 - y) * size_t(size_) + size_t(x)];
      image.setRgb(size_t(y) * size_t(size_) + size_t(x),
                   glm::vec3(flux > kDark ? 0.45f + 0.4f * flux : 1.0f));
    }
  return image;
}

std::vector<Receiver> receiversOf(Renderer& renderer, Scene scene, RenderSettings settings) {
  const ParallelLight& light = std::get<ParallelLight>(scene.lights.at(0));
  scene.camera = OrbitCamera{.azimuth = light.azimuth, .elevation = light.elevation, .fov = 2};
  renderer.draw(scene, settings);
  std::vector<Receiver> receivers;
  for (int y = 0; y < settings.height; ++y)
    for (int x = 0; x < settings.width; ++x) {
      const auto seen = RendererTextures::samplesAt(renderer, scene, settings, {x, y}, 0);
      if (!seen) continue;
      Receiver receiver{.place = seen->receiverUv * double(settings.mapSize)};
      for (const SeenSample& sample : seen->samples) {
        const double side = sample.width * settings.mapSize;
        receiver.samples.push_back({sample.uv * double(settings.mapSize), sample.level, side * side});
      }
      receivers.push_back(std::move(receiver));
    }
  return receivers;
}

Coverage coverageOf(const FluxMap& map, const std::vector<Sample>& samples) {
  Coverage coverage;
  std::vector<bool> inside(size_t(map.size()) * size_t(map.size()));
  for (const Sample& sample : samples) {
    coverage.flux += sample.area * map.mean(sample.place, int(std::lround(sample.level)));
    const double half = 0.5 * std::sqrt(sample.area);
    const auto first = [&](double v) { return std::max(0, int(std::floor(v - half + 0.5))); };
    const auto last = [&](double v) {
      return std::min(map.size(), std::max(first(v) + 1, int(std::floor(v + half + 0.5))));
    };
    for (int y = first(sample.place.y); y < last(sample.place.y); ++y)
      for (int x = first(sample.place.x); x < last(sample.place.x); ++x)
        inside[size_t(y) * size_t(map.size()) + size_t(x)] = true;
  }
  double lit = 0, covered = 0;
  for (int y = 0; y < map.size(); ++y)
    for (int x = 0; x < map.size(); ++x) {
      if (map.mean({x + 0.5, y + 0.5}, 0) <= double(kDark)) continue;
      lit += 1;
      covered += inside[size_t(y) * size_t(map.size()) + size_t(x)] ? 1 : 0;
    }
  coverage.area = covered / std::max(lit, 1.0);
  coverage.flux /= std::max(map.total(), 1e-12);
  return coverage;
}

}  // namespace lychnite::paper
