#include "lychnite/app/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <thread>

#include "app/bench_growth.h"
#include "app/bench_scenes.h"
#include "app/bench_timer.h"
#include "app/date.h"
#include "lychnite/app/image_maker.h"
#include "lychnite/base/error.h"
#include "lychnite/gpu/context.h"
#include "lychnite/technique/renderer.h"
#include "lychnite/volume/volume.h"

namespace lychnite {
namespace {

namespace fs = std::filesystem;
using namespace bench;

constexpr int kLatticeSamples = 49;  // of the paper's pattern, whatever the settings
// What the volume method is when it must be quick (docs/volume.md).
constexpr VolumeSettings kLiveVolume{.cells = kLiveVolumeCells};

double loadOfMachine() {
  double load = 0;
  getloadavg(&load, 1);
  return load;
}

RenderSettings settingsOf(Method method, bool quick) {
  RenderSettings settings;
  settings.method = method;
  if (quick) settings.width = settings.height = 150;
  if (quick) settings.mapSize = 256;
  settings.mostMapSize = settings.mapSize;
  return settings;
}

/// Bytes that the passes of a frame read and write, had nothing a cache (docs/performance.md).
size_t movedBytes(const BenchRow& row, bool keepsMap) {
  const size_t pixels = size_t(row.width) * size_t(row.height), lattice = row.method == "matched" ? 0 : 1;
  const size_t mesh = row.vertices * 24 + row.triangles * 12;
  const size_t map = keepsMap ? 0 : 2 * row.mapBytes + mesh;  // drawn, and read once for the mips
  const size_t geometry = 4 * pixels * 16;                    // 2 x 2 samples a pixel
  const size_t taps = lattice ? 4 * 8 : 8 * 16;               // bilinear of two floats, trilinear of four
  const size_t multiple = row.coveredPixels * size_t(row.samples) * taps;
  const size_t single = row.coveredPixels * size_t(row.singleSamples) * (8 + 4);
  const size_t layers = 2 * 3 * pixels * 16 + pixels * 16;
  return map + mesh + 4 * geometry + multiple + single + layers;
}

/// Counts the rows done, so that progress is of the whole.
class Bench {
 public:
  Bench(const BenchSettings& settings, const Progress& progress)
      : settings_(settings),
        progress_(progress),
        context_({.device = settings.device}, settings.log),
        renderer_({.useCurrentContext = true, .log = settings.log}) {
    for (const Model& model : models())
      if (isWanted(model)) models_.push_back(model);
    steps_ = double(models_.size()) * rowsOfAModel();
    if (settings.limits) steps_ += 1;
    if (settings.growth) steps_ += growthPoints(settings);
  }

  BenchReport run() {
    BenchReport report{.version = versionText(), .date = today()};
    report.device = context_.device().renderer;
    report.driver = context_.device().version;
    report.software = context_.device().software;
    report.cores = int(std::thread::hardware_concurrency());
    report.frames = settings_.frames;
    report.warmUp = settings_.warmUp;
    report.load[0] = loadOfMachine();
    for (const Model& model : models_) addRows(model, report.rows);
    if (settings_.limits) {
      tell("the device's limits", 0);
      report.limits = measureLimits(context_, settings_.quick);
      ++done_;
    }
    if (settings_.growth)
      report.growth = measureGrowth(settings_, context_, renderer_, [&](const std::string& what) {
        tell(what, 0);
        ++done_;
      });
    report.load[1] = loadOfMachine();
    context_.checkErrors("bench");
    return report;
  }

 private:
  bool isWanted(const Model& model) const {
    if (!settings_.scenes.empty())
      return std::find(settings_.scenes.begin(), settings_.scenes.end(), model.name) !=
             settings_.scenes.end();
    return !settings_.quick || std::string_view(model.name) == "stone";
  }

  /// The kinds of change that a method is timed under.
  std::vector<std::string> changesOf(Method method) const {
    if (!settings_.changes.empty()) return settings_.changes;
    if (method == Method::kVolume) return {"all", "light", "camera"};
    return {"all", "camera"};
  }

  double rowsOfAModel() const {
    size_t rows = 0;
    for (const Method method : settings_.methods) rows += changesOf(method).size();
    return double(rows);
  }

  void addRows(const Model& model, std::vector<BenchRow>& rows) {
    const std::string missing = missingText(model, settings_.models);
    std::optional<Scene> scene;
    if (missing.empty()) scene = sceneOf(model, settings_.models, settings_.log);
    for (const Method method : settings_.methods)
      for (const std::string& change : changesOf(method)) {
        BenchRow row{.scene = model.name, .method = methodName(method), .change = change, .missing = missing};
        if (scene && method == Method::kVolume) {
          const std::string obstacle = volume_.obstacle(*scene);
          if (!obstacle.empty()) row.missing = "has no inside: " + obstacle;
        }
        if (row.missing.empty()) measure(*scene, settingsOf(method, settings_.quick), row);
        rows.push_back(std::move(row));
        ++done_;
      }
  }

  void measure(const Scene& base, const RenderSettings& settings, BenchRow& row) {
    row.width = settings.width;
    row.height = settings.height;
    const bool isVolume = settings.method == Method::kVolume;
    if (!isVolume) row.mapSize = settings.mapSize;
    if (!isVolume)
      row.samples = settings.method == Method::kMatched ? settings.multipleSamples : kLatticeSamples;
    row.singleSamples = settings.singleSamples;
    const Drawing drawing = isVolume ? volumeDrawing(settings) : realTimeDrawing(settings);
    countPixels(changed(base, row.change, -settings_.warmUp), row);
    FrameTimer timer(drawing), unused(drawing);
    for (int i = -settings_.warmUp; i < settings_.frames; ++i) {
      tell(fmt::format("{} {} {}", row.scene, row.method, row.change),
           double(i + settings_.warmUp) / (settings_.frames + settings_.warmUp));
      (i < 0 ? unused : timer).frame(changed(base, row.change, i));
    }
    row.frameMs = timer.wall();
    row.frame = statisticOf(row.frameMs);
    row.cpuMs = timer.cpu();
    row.passes = timer.passes();
    row.mapBytes = isVolume ? 0 : renderer_.stats().mapBytes;
    row.gpuBytes = isVolume ? 0 : renderer_.stats().gpuBytes;
    row.memoryBytes = isVolume ? volume_.stats().memoryBytes : 0;
    if (!isVolume) row.movedBytes = movedBytes(row, row.change == "camera");
  }

  /// Only a picture that is read back has its covered pixels counted.
  void countPixels(const Scene& scene, BenchRow& row) {
    RenderSettings settings;
    settings.width = row.width;
    settings.height = row.height;
    settings.components = {.multiple = false, .single = false, .surface = true};
    renderer_.render(scene, settings);
    row.coveredPixels = renderer_.stats().coveredPixels;
    row.triangles = renderer_.stats().triangles;
    row.vertices = renderer_.stats().vertices;
  }

  Drawing realTimeDrawing(const RenderSettings& settings) {
    return {.draw =
                [this, settings](const Scene& scene) {
                  renderer_.draw(scene, settings);
                  context_.finish();
                },
            .passes =
                [this] {
                  std::vector<std::pair<std::string, double>> passes;
                  for (const RenderStats::Pass& pass : renderer_.stats().passes)
                    passes.emplace_back(pass.name, pass.gpuMs);
                  return passes;
                }};
  }

  Drawing volumeDrawing(const RenderSettings& settings) {
    return {.draw =
                [this, settings](const Scene& scene) {
                  volume_.update(scene, kLiveVolume);
                  const double start = wallMs();
                  volume_.picture(settings, {}, VolumeSolver::Detail::kPreview);
                  pictureMs_ = wallMs() - start;
                },
            .passes =
                [this] {
                  const VolumeStats& s = volume_.stats();
                  return std::vector<std::pair<std::string, double>>{{"geometry", s.geometryMs},
                                                                     {"source", s.sourceMs},
                                                                     {"solve", s.solveMs},
                                                                     {"exchange", s.exchangeMs},
                                                                     {"picture", pictureMs_}};
                }};
  }

  void tell(const std::string& what, double part) const {
    progress_.check({.what = "bench", .fraction = std::min(1.0, (done_ + part) / steps_), .detail = what});
  }

  const BenchSettings& settings_;
  const Progress& progress_;
  std::vector<Model> models_;
  gpu::Context context_;  // before the renderer, which draws in it
  Renderer renderer_;
  VolumeSolver volume_;
  double pictureMs_ = 0, steps_ = 1;
  int done_ = 0;
};

[[noreturn]] void refuse(std::string where, std::string expected, std::string found) {
  throw Error(
      {.where = std::move(where), .expected = std::move(expected), .found = std::move(found), .todo = ""},
      Error::Kind::kUsage);
}

}  // namespace

void validate(const BenchSettings& settings) {
  constexpr const char* kMethods = "any of fixed,adaptive,matched,volume";
  if (settings.methods.empty()) refuse("methods", kMethods, "none");
  for (const Method method : settings.methods)
    if (isReference(method)) refuse("methods", kMethods, fmt::format("'{}'", methodName(method)));
  if (settings.frames < 1 || settings.frames > 100'000)
    refuse("frames", "1 to 100000", std::to_string(settings.frames));
  if (settings.warmUp < 1 || settings.warmUp > 100'000)
    refuse("warm-up", "1 to 100000", std::to_string(settings.warmUp));
  for (const std::string& scene : settings.scenes) {
    bool known = false;
    for (const Model& model : models()) known = known || scene == model.name;
    if (!known)
      refuse("scenes", "any of stone,candle,knot,figurine,bunny,dragon", fmt::format("'{}'", scene));
  }
  for (const std::string& change : settings.changes)
    if (change != "all" && change != "light" && change != "camera")
      refuse("changes", "any of all,light,camera", fmt::format("'{}'", change));
  if (!settings.models.empty() && !fs::is_directory(settings.models))
    refuse("models", "a folder", fmt::format("'{}'", settings.models.string()));
}

BenchReport runBench(const BenchSettings& settings, const Progress& progress) {
  validate(settings);
  return Bench(settings, progress).run();
}

}  // namespace lychnite
