// Loading, walk steps a second, and the hierarchical method's build. Usage: micro_bench
// [--benchmark_filter=...]
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "lychnite/mesh/builtin.h"
#include "lychnite/mesh/load.h"
#include "lychnite/optics/materials.h"
#include "lychnite/reference/reference.h"
#include "lychnite/reference/slab.h"
#include "lychnite/scene/scene_file.h"

namespace {

using namespace lychnite;
namespace fs = std::filesystem;

/// A built-in model as a file that goes away with it.
class ModelFile {
 public:
  ModelFile(const char* model, const char* extension)
      : path_(fs::temp_directory_path() / ("micro_bench_" + std::to_string(getpid()) + extension)) {
    const Mesh& mesh = *builtinMesh(model);
    std::ostringstream text;
    const bool obj = std::string_view(extension) == ".obj";
    if (!obj) {
      text << "ply\nformat ascii 1.0\nelement vertex " << mesh.positions.size()
           << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.triangles.size()
           << "\nproperty list uchar int vertex_indices\nend_header\n";
    }
    for (const glm::vec3& p : mesh.positions)
      text << (obj ? "v " : "") << p.x << ' ' << p.y << ' ' << p.z << '\n';
    const uint32_t first = obj ? 1 : 0;
    for (const glm::uvec3& t : mesh.triangles)
      text << (obj ? "f " : "3 ") << t.x + first << ' ' << t.y + first << ' ' << t.z + first << '\n';
    std::ofstream(path_) << text.str();
  }
  ~ModelFile() { fs::remove(path_); }
  ModelFile(const ModelFile&) = delete;
  ModelFile& operator=(const ModelFile&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Scene figurine(double size) {
  Scene scene;
  scene.objects = {loadObject("figurine")};
  scene.objects[0].size = size;
  scene.objects[0].material.medium = findMaterial("marble", "bench").coefficients;
  scene.lights = {ParallelLight{.azimuth = 140, .elevation = 30}};
  return scene;
}

RenderSettings small(Method method) {
  RenderSettings settings;
  settings.width = settings.height = 64;
  settings.method = method;
  settings.components = {.multiple = true, .single = false, .surface = false};
  settings.threads = 1;
  return settings;
}

void load(benchmark::State& state, const char* extension) {
  const ModelFile file("figurine", extension);
  size_t triangles = 0;
  for (auto _ : state) triangles += loadMesh(file.path()).mesh->triangles.size();
  state.counters["triangles/s"] = benchmark::Counter(double(triangles), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(load, ply, ".ply")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load, obj, ".obj")->Unit(benchmark::kMillisecond);

/// Steps of the transport: a photon that is never weighted collides absorbed / (1 - albedo) times on average.
void slabSteps(benchmark::State& state) {
  constexpr double kAlbedo = 0.99;
  SlabSettings settings;
  settings.medium.sigma_s = Rgb(kAlbedo);
  settings.medium.sigma_a = Rgb(1 - kAlbedo);
  settings.photons = 20'000;
  settings.threads = 1;
  double steps = 0;
  for (auto _ : state) {
    steps += double(settings.photons) * simulateSlab(settings).absorbed.value.x / (1 - kAlbedo);
    ++settings.seed;
  }
  state.counters["steps/s"] = benchmark::Counter(steps, benchmark::Counter::kIsRate);
}
BENCHMARK(slabSteps)->Unit(benchmark::kMillisecond);

void walkPhotons(benchmark::State& state) {
  const Scene scene = figurine(double(state.range(0)));
  RenderSettings settings = small(Method::kWalk);
  settings.samples = 4;
  for (auto _ : state) {
    benchmark::DoNotOptimize(renderReference(scene, settings));
    ++settings.seed;
  }
  state.counters["photons/s"] =
      benchmark::Counter(settings.samples * settings.width * settings.height * double(state.iterations()),
                         benchmark::Counter::kIsRate);
}
BENCHMARK(walkPhotons)->Arg(1)->Arg(10)->Arg(100)->Unit(benchmark::kMillisecond);

/// A picture of 1 x 1 pixels: samples, octree and irradiance, and next to nothing else.
void hierarchicalBuild(benchmark::State& state) {
  const Scene scene = figurine(double(state.range(0)));
  RenderSettings settings = small(Method::kHierarchical);
  settings.width = settings.height = 1;
  for (auto _ : state) benchmark::DoNotOptimize(renderReference(scene, settings));
}
BENCHMARK(hierarchicalBuild)->Arg(1)->Arg(10)->Arg(100)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
