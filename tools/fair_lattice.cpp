// Measures the fair form of the paper's lattice for docs/sampling.md: its 49 cells at the spacing that Yao &
// Wang 2009 eq. 4 gives, each standing for the area that this spacing implies, so that no gap is left between
// them, at the level of that area (not a whole number), over the map of flux and its depth that `matched`
// reads, without the cosine too many. On the CPU, in double precision; against the hierarchical judge, with
// sampling_table's sizes and lights. Usage: fair_lattice [--materials LIST] MODEL... (built-in names or
// files)
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "lychnite/app/image_maker.h"
#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/image/metrics.h"
#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/profile.h"
#include "lychnite/scene/scene_file.h"
#include "reference/camera_receivers.h"
#include "sampling_cells.h"
#include "technique/frame.h"
#include "technique/light_map/light_map_pass.h"
#include "technique/multiple/lattice.h"
#include "technique/renderer_textures.h"

namespace {

using namespace lychnite;
using namespace lychnite::sampling;

constexpr int kMap = 512;

/// The map's flux and flux-weighted depth with all its levels, trilinear.
class Moments {
 public:
  explicit Moments(const LightMapPass::Map& map) : side_(map.moments->width()) {
    for (int level = 0; level < map.moments->levels(); ++level)
      levels_.push_back(map.moments->download(level));
  }
  int side() const { return side_; }
  /// Flux and flux z.
  glm::dvec2 at(const glm::dvec2& uv, double level) const {
    const double clamped = std::clamp(level, 0.0, double(levels_.size() - 1));
    const int low = int(clamped), high = std::min(low + 1, int(levels_.size()) - 1);
    return glm::mix(bilinear(uv, low), bilinear(uv, high), clamped - low);
  }

 private:
  glm::dvec2 bilinear(const glm::dvec2& uv, int level) const {
    const int side = std::max(1, side_ >> level);
    const glm::dvec2 t = uv * double(side) - 0.5;
    const glm::ivec2 base(glm::floor(t));
    const glm::dvec2 f = t - glm::dvec2(base);
    glm::dvec2 sum(0);
    for (int i = 0; i < 4; ++i) {
      const glm::ivec2 at = base + glm::ivec2(i & 1, i >> 1);
      if (at.x < 0 || at.y < 0 || at.x >= side || at.y >= side) continue;
      const size_t texel = (size_t(at.y) * size_t(side) + size_t(at.x)) * 4;
      const double w = (i & 1 ? f.x : 1 - f.x) * (i >> 1 ? f.y : 1 - f.y);
      const std::vector<float>& values = levels_[size_t(level)];
      sum += w * glm::dvec2(values[texel], values[texel + 1]);
    }
    return sum;
  }

  int side_;
  std::vector<std::vector<float>> levels_;
};

/// Cells for a slope of eq. 4: the map x -> x 2^(slope |x|) stretches areas by 4^(slope |x|) (1 + slope |x|
/// ln 2).
struct Cell {
  glm::dvec2 offset;  ///< texels
  double area;        ///< texels
};

std::vector<Cell> fairLattice(double slope) {
  std::vector<Cell> cells;
  for (int y = -3; y <= 3; ++y)
    for (int x = -3; x <= 3; ++x) {
      const double levels = std::max(0.0, slope) * std::hypot(x, y), step = std::exp2(levels);
      cells.push_back({step * glm::dvec2(x, y), step * step * (1 + levels * std::log(2.0))});
    }
  return cells;
}

/// One scene's map, receivers and reference, to try lattices on.
class Bench {
 public:
  Bench(Renderer& renderer, const Scene& scene, const Image& reference)
      : frame_(makeFrame(scene, reference.width(), reference.height())),
        rays_(scene),
        receivers_(findReceivers(rays_, reference.width(), reference.height())),
        reference_(reference),
        table_(*makeProfile({}, {ProfileKind::kDipole, frame_.objects[0].medium, ProfileOrders::kFromSecond},
                            {}),
               1) {
    RenderSettings settings = settingsOf(Method::kMatched);
    settings.mapSize = settings.mostMapSize = kMap;
    renderer.draw(scene, settings);
    const LightMapPass::Map& map = RendererTextures::maps(renderer).get(0, 0);
    view_ = map.view;
    moments_.emplace(map);
  }

  double error(const std::vector<Cell>& cells) const {
    Image image = reference_;
    for (size_t i = 0; i < image.pixelCount(); ++i) image.setRgb(i, glm::vec3(0));
    const double eta = frame_.objects[0].medium.eta;
    for (const Receiver& receiver : receivers_.receivers) {
      const glm::dvec3 mm = rays_.origin() + glm::dvec3(receiver.hit.position) * rays_.unit();
      const double cosO = std::max(0.0, double(glm::dot(receiver.normal, receiver.view)));
      const Rgb radiance = double(receiver.weight) * exitLobe(cosO, eta) *
                           radiosity((mm - frame_.origin) / frame_.unit, cells);
      image.setRgb(receiver.pixel, glm::vec3(glm::dvec3(image.rgb(receiver.pixel)) + radiance));
    }
    return compare(image, reference_).together.relative_rmse;
  }

 private:
  Rgb radiosity(const glm::dvec3& receiver, const std::vector<Cell>& cells) const {
    const glm::dvec2 centre(view_.project(receiver));
    const double texel = 2 * view_.halfWidth / moments_->side();
    Rgb sum(0);
    for (const Cell& cell : cells) {
      const glm::dvec2 uv = centre + cell.offset / double(moments_->side());
      const glm::dvec2 m = moments_->at(uv, 0.5 * std::log2(cell.area));
      if (m.x < 1e-7) continue;
      const glm::dvec3 p = view_.unproject(uv, view_.centreDepth - m.y / m.x);
      sum += cell.area * texel * texel * m.x * Rgb(table_.Rd(glm::distance(p, receiver)));
    }
    return sum * view_.power;
  }

  Frame frame_;
  RayScene rays_;
  CameraReceivers receivers_;
  Image reference_;
  ProfileTable table_;
  LightView view_;
  std::optional<Moments> moments_;
};

struct Mean {
  double sum = 0;
  int count = 0;
  void add(double error) { sum += error, ++count; }
};

/// Errors by constants of eq. 4, then by light and size ("" for all).
using Errors = std::map<std::pair<double, double>, std::map<std::string, Mean>>;

void measure(Renderer& renderer, ImageMaker& maker, const Object& object, const std::string& material,
             Errors& errors) {
  for (const auto& [name, light] : kLights)
    for (const double size : kSizes) {
      const Scene scene = sceneOf(object, material, size, light);
      const Image reference = maker.render(scene, settingsOf(Method::kHierarchical));
      if (isBlack(reference)) continue;
      const Bench bench(renderer, scene, reference);
      const Coefficients& medium = scene.objects[0].material.medium;
      for (const double C1 : {1.2, 1.4, 1.6, 1.8})
        for (const double C2 : {0.1, 0.2, 0.3}) {
          const double error = bench.error(fairLattice(latticeSlope({C1, C2, 1}, medium, size)));
          auto& means = errors[{C1, C2}];
          for (const std::string& key : {std::string(), std::string(name), fmt::format("{:g} mm", size)})
            means[key].add(error);
        }
      fmt::print(stderr, "\r{} {} {} mm      ", material, name, size);
    }
}

void print(const Errors& errors) {
  const auto best = std::min_element(errors.begin(), errors.end(), [](const auto& a, const auto& b) {
    return a.second.at("").sum < b.second.at("").sum;
  });
  fmt::print("| C1 | C2 | mean, % |\n|-|-|-|\n");
  for (const auto& [constants, means] : errors)
    fmt::print("| {} | {} | {:.1f} |\n", constants.first, constants.second,
               100 * means.at("").sum / means.at("").count);
  fmt::print("\nBest: C1 {}, C2 {}\n", best->first.first, best->first.second);
  for (const auto& [key, mean] : best->second)
    fmt::print("{}: {:.1f} % ({} cells)\n", key.empty() ? "all" : key, 100 * mean.sum / mean.count,
               mean.count);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::vector<std::string> materials{"fig6", "marble", "skin1", "wholemilk", "skimmilk", "ketchup"}, models;
    for (int i = 1; i < argc; ++i) {
      if (argv[i] == std::string("--materials") && i + 1 < argc)
        materials = split(argv[++i], ',');
      else
        models.push_back(argv[i]);
    }
    ImageMaker maker({});
    Renderer renderer;
    Errors errors;
    for (const std::string& model : models) {
      const Object object = loadObject(model);
      for (const std::string& material : materials) measure(renderer, maker, object, material, errors);
    }
    if (errors.empty())
      throw Error({.where = "models",
                   .expected = "at least one",
                   .found = "none",
                   .todo = "name built-in models or mesh files"});
    print(errors);
  } catch (const Error& error) {
    fmt::print(stderr, "fair_lattice: {}\n", error.what());
    return 1;
  }
}
