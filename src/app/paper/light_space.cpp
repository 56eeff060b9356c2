#include "app/paper/light_space.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "technique/multiple/lattice.h"
#include "technique/multiple/spiral.h"
#include "technique/renderer_textures.h"

namespace lychnite::paper {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr float kDark = 1e-4f;  // a texel with less flux shows no surface

double radialShare(double r, double scale) {
  return r / (r + scale);
}

double radiusOfShare(double share, double scale) {
  return scale * share / std::max(1e-6, 1 - share);
}

double distanceToCircle(double e0, double rc, double cosine, double sine) {
  const double s = e0 * sine;
  return e0 * cosine + std::sqrt(std::max(0.0, rc * rc - s * s));
}

/// The spiral in mm around a receiver at `p` from the axis of a circle of radius `rc`.
struct Spiral {
  double scale, reach, rc, e0, e;
  glm::dvec2 inwards{1, 0};

  Spiral(const Profile& profile, const glm::dvec2& p, double radius)
      : scale(spiralScale(profile)),
        reach(spiralReach(profile)),
        rc(radius),
        e0(std::min(glm::length(p), 0.999 * radius)) {
    if (e0 > 1e-6) inwards = -p / glm::length(p);
    const double far = radialShare(std::min(rc + e0, reach), scale);
    const double near = radialShare(std::min(rc - e0, reach), scale);
    const double wanted = 0.9 * (far - near) / std::max(1e-9, far + near);
    e = wanted / (1 + wanted);
  }

  /// Offset and area of cell `i` of `count`.
  std::pair<glm::dvec2, double> cell(int i, int count) const {
    const double turns = 0.6180339887498949 * i - std::atan2(inwards.y, inwards.x) / (2 * kPi) - 0.5;
    const double even = 1 / (1 + e * std::cos(2 * kPi * turns)), squeeze = std::sqrt(1 - e * e);
    const double cosine = (std::cos(2 * kPi * turns) + e) * even;
    const double sine = squeeze * std::sin(2 * kPi * turns) * even;
    const double share = radialShare(std::min(distanceToCircle(e0, rc, cosine, sine), reach), scale);
    const double a = radiusOfShare(share * i / count, scale);
    const double q = radiusOfShare(share * (i + 0.5) / count, scale);
    const double b = radiusOfShare(share * (i + 1) / count, scale);
    return {q * (cosine * inwards + sine * glm::dvec2(-inwards.y, inwards.x)),
            kPi * (b * b - a * a) * squeeze * even};
  }
};

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
  radius_ = boundingSphere(scene.objects[0]).radius;
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

std::vector<Sample> latticeSamples(const FluxMap& map, const glm::dvec2& receiver, double slope) {
  std::vector<Sample> samples;
  for (const glm::vec4& cell : makeLattice(slope, int(std::log2(map.size()))))
    samples.push_back({receiver + glm::dvec2(cell.x, cell.y), double(cell.z), double(cell.w)});
  return samples;
}

std::vector<Sample> spiralSamples(const FluxMap& map, const glm::dvec2& receiver, const Profile& profile,
                                  int count) {
  const glm::dvec2 p = (receiver - glm::dvec2(0.5 * map.size())) * map.texel();
  const Spiral spiral(profile, p, 1.05 * map.boundRadius() + map.texel());
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    const auto [offset, area] = spiral.cell(i, count);
    const double texels = area / (map.texel() * map.texel());
    samples.push_back({receiver + offset / map.texel(), std::max(0.0, 0.5 * std::log2(texels) - 1), texels});
  }
  return samples;
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

std::vector<glm::dvec2> litPlaces(const FluxMap& map, int perSide) {
  std::vector<glm::dvec2> places;
  for (int y = 0; y < perSide; ++y)
    for (int x = 0; x < perSide; ++x) {
      const glm::dvec2 place = glm::dvec2(x + 0.5, y + 0.5) * (double(map.size()) / perSide);
      if (map.mean(place, 0) > double(kDark)) places.push_back(place);
    }
  return places;
}

}  // namespace lychnite::paper
