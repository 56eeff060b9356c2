#include "app/bench_growth.h"

#include <fmt/format.h>

#include <cmath>

#include "app/bench_scenes.h"
#include "app/bench_timer.h"
#include "lychnite/mesh/builtin.h"
#include "lychnite/mesh/mesh.h"

namespace lychnite {
namespace bench {
namespace {

/// What grows, and the values that it takes.
struct Over {
  const char* name;
  std::vector<double> values, quickValues;
};
const Over kOvers[] = {{"lines", {300, 600, 1080, 2160}, {75, 150}},
                       {"map_size", {256, 512, 1024, 2048}, {128, 256}},
                       {"samples", {8, 16, 32, 64, 128}, {8, 32}},
                       {"lights", {1, 2, 4, 8}, {1, 2}},
                       {"triangles", {1e3, 1e4, 1e5, 1e6}, {1e3, 1e4}}};

const std::vector<double>& valuesOf(const Over& over, bool quick) {
  return quick ? over.quickValues : over.values;
}

/// A stone-like body of about that many triangles: a sphere of rings with a wave on it.
std::shared_ptr<const Mesh> bodyOf(double triangles) {
  const int rings = std::max(4, int(std::lround(std::sqrt(triangles / 4)))), around = 2 * rings;
  constexpr double kPi = 3.14159265358979323846;
  auto mesh = std::make_shared<Mesh>();
  const auto point = [&](double turn, double rise) {
    const double r = 0.45 + 0.04 * std::sin(5 * turn) * std::cos(3 * rise);
    return glm::vec3(r * std::cos(rise) * std::cos(turn), r * std::sin(rise),
                     r * std::cos(rise) * std::sin(turn));
  };
  mesh->positions.push_back(point(0, -kPi / 2));
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < around; ++j)
      mesh->positions.push_back(point(2 * kPi * j / around, kPi * i / rings - kPi / 2));
  mesh->positions.push_back(point(0, kPi / 2));
  const auto at = [&](int i, int j) { return uint32_t(1 + (i - 1) * around + j % around); };
  const auto top = uint32_t(mesh->positions.size() - 1);
  for (int j = 0; j < around; ++j) {
    mesh->triangles.emplace_back(0, at(1, j), at(1, j + 1));
    mesh->triangles.emplace_back(top, at(rings - 1, j + 1), at(rings - 1, j));
    for (int i = 1; i + 1 < rings; ++i) {
      mesh->triangles.emplace_back(at(i, j), at(i + 1, j), at(i, j + 1));
      mesh->triangles.emplace_back(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
    }
  }
  mesh->normals = angleWeightedNormals(mesh->positions, mesh->triangles);
  mesh->extent = extentOf(*mesh);
  return mesh;
}

/// One case: what is drawn, and how.
struct Case {
  Scene scene;
  RenderSettings settings;
  double value = 0;  ///< as it came out: a mesh has about as many triangles as it was asked for
};

Case caseOf(const Over& over, double value, Method method, bool quick) {
  Case result{.scene = sceneOf(models()[0], {}, {}), .value = value};
  result.settings.method = method;
  if (quick) result.settings.width = result.settings.height = 100;
  if (quick) result.settings.mapSize = 128;
  const std::string_view name = over.name;
  if (name == "lines") {
    result.settings.width = result.settings.height = int(value);
  } else if (name == "map_size") {
    result.settings.mapSize = int(value);
  } else if (name == "samples") {
    result.settings.multipleSamples = int(value);
  } else if (name == "lights") {
    result.scene.lights.clear();
    for (int i = 0; i < int(value); ++i)
      result.scene.lights.push_back(ParallelLight{.azimuth = 40.0 * i, .elevation = 30});
  } else {
    result.scene.objects[0].mesh = bodyOf(value);
    result.value = double(result.scene.objects[0].mesh->triangles.size());
  }
  result.settings.mostMapSize = result.settings.mapSize;
  return result;
}

BenchGrowth::Point measure(const Case& base, int frames, gpu::Context& context, Renderer& renderer) {
  const Drawing drawing{.draw =
                            [&](const Scene& scene) {
                              renderer.draw(scene, base.settings);
                              context.finish();
                            },
                        .passes =
                            [&] {
                              std::vector<std::pair<std::string, double>> passes;
                              for (const RenderStats::Pass& pass : renderer.stats().passes)
                                passes.emplace_back(pass.name, pass.gpuMs);
                              return passes;
                            }};
  FrameTimer timer(drawing), unused(drawing);
  for (int i = -2; i < frames; ++i) (i < 0 ? unused : timer).frame(changed(base.scene, "all", i));
  return {base.value, statisticOf(timer.wall()), timer.cpu(), timer.passes()};
}

bool applies(const Over& over, Method method) {
  return std::string_view(over.name) != "samples" || method == Method::kMatched;
}

}  // namespace

int growthPoints(const BenchSettings& settings) {
  int points = 0;
  for (const Method method : settings.methods)
    for (const Over& over : kOvers)
      if (method != Method::kVolume && applies(over, method))
        points += int(valuesOf(over, settings.quick).size());
  return points;
}

std::vector<BenchGrowth> measureGrowth(const BenchSettings& settings, gpu::Context& context,
                                       Renderer& renderer,
                                       const std::function<void(const std::string& what)>& point) {
  std::vector<BenchGrowth> result;
  for (const Over& over : kOvers)
    for (const Method method : settings.methods) {
      if (method == Method::kVolume || !applies(over, method)) continue;
      BenchGrowth growth{.over = over.name, .method = methodName(method)};
      for (const double value : valuesOf(over, settings.quick)) {
        point(fmt::format("{} over {} {:g}", growth.method, over.name, value));
        const Case one = caseOf(over, value, method, settings.quick);
        growth.points.push_back(measure(one, std::min(settings.frames, 7), context, renderer));
      }
      fitExponent(growth);
      result.push_back(std::move(growth));
    }
  return result;
}

}  // namespace bench

void fitExponent(BenchGrowth& growth) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
  for (const BenchGrowth::Point& point : growth.points) {
    if (!(point.value > 0) || !(point.frame.median > 0)) continue;
    const double x = std::log(point.value), y = std::log(point.frame.median);
    n += 1;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
    syy += y * y;
  }
  const double spread = n * sxx - sx * sx;
  growth.exponent = growth.exponentError = 0;
  if (n < 2 || !(spread > 0)) return;
  growth.exponent = (n * sxy - sx * sy) / spread;
  if (n < 3) return;
  const double residual = std::max(0.0, (n * syy - sy * sy) - growth.exponent * growth.exponent * spread);
  growth.exponentError = std::sqrt(residual / ((n - 2) * spread));
}

}  // namespace lychnite
