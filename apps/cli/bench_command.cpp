#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "commands.h"
#include "lychnite/app/bench.h"
#include "lychnite/base/atomic_file.h"
#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "terminal.h"

namespace lychnite::cli {
namespace {

namespace fs = std::filesystem;

struct Flags {
  std::string methods = "adaptive,matched,volume", scenes, changes, models, json, compare, results,
              device = "auto";
  int frames = 0, warmUp = 0;
  bool quick = false, growth = false, limits = false;
};

BenchSettings settingsFrom(const Flags& flags) {
  BenchSettings settings;
  settings.methods.clear();
  for (const std::string& name : split(flags.methods, ','))
    settings.methods.push_back(parseMethod(name, "--methods"));
  if (!flags.scenes.empty()) settings.scenes = split(flags.scenes, ',');
  if (!flags.changes.empty()) settings.changes = split(flags.changes, ',');
  settings.quick = flags.quick;
  settings.growth = flags.growth;
  settings.limits = flags.limits || !flags.quick;
  if (flags.quick) settings.frames = 5;
  if (flags.frames > 0) settings.frames = flags.frames;
  if (flags.warmUp > 0) settings.warmUp = flags.warmUp;
  settings.models = flags.models;
  settings.device = flags.device;
  settings.log = terminalLog(false);
  validate(settings);
  return settings;
}

/// What can be known to fail is said before minutes are spent on measuring.
void checkFiles(const Flags& flags) {
  if (flags.json.empty()) return;
  const fs::path path = flags.json;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (fs::is_directory(path) || !fs::is_directory(folder))
    throw Error({.where = "--json",
                 .expected = "a file name in a folder that exists",
                 .found = fmt::format("'{}'", flags.json),
                 .todo = ""},
                Error::Kind::kUsage);
}

std::string pm(const Statistic& s) {
  const int digits = s.median < 10 ? 2 : 1;
  return fmt::format("{:.{}f} ~ {:.{}f}", s.median, digits, s.deviation, digits);
}

void printFrames(const BenchReport& report) {
  fmt::print("{:9} {:9} {:7} {:>16} {:>7} {:>16} {:>8} {:>8} {:>8} {:>8} {:>7} {:>8}\n", "scene", "method",
             "change", "frame ms", "fps", "CPU ms", "tri.", "vert.", "covered", "samples", "map MB",
             "moved MB");
  for (const BenchRow& row : report.rows) {
    fmt::print("{:9} {:9} {:7} ", row.scene, row.method, row.change);
    if (!row.missing.empty()) {
      fmt::print("{}\n", row.missing);
      continue;
    }
    fmt::print("{:>16} {:>7.2f} {:>16} {:>8} {:>8} {:>8} {:>8} {:>7.2f} {:>8.1f}\n", pm(row.frame),
               row.framesPerSecond(), pm(row.cpuMs), row.triangles, row.vertices, row.coveredPixels,
               fmt::format("{}+{}", row.samples, row.singleSamples), double(row.mapBytes) / 1e6,
               double(row.movedBytes) / 1e6);
  }
}

void printPasses(const BenchReport& report) {
  std::vector<std::string> names;
  for (const BenchRow& row : report.rows)
    for (const BenchPass& pass : row.passes)
      if (std::find(names.begin(), names.end(), pass.name) == names.end()) names.push_back(pass.name);
  fmt::print("\n{:9} {:9} {:7}", "GPU ms of", "", "");
  for (const std::string& name : names) fmt::print(" {:>15}", name);
  fmt::print("\n");
  for (const BenchRow& row : report.rows) {
    if (!row.missing.empty()) continue;
    fmt::print("{:9} {:9} {:7}", row.scene, row.method, row.change);
    for (const std::string& name : names) {
      const auto pass = std::find_if(row.passes.begin(), row.passes.end(),
                                     [&](const BenchPass& other) { return other.name == name; });
      fmt::print(" {:>15}", pass == row.passes.end() ? "-" : pm(pass->gpuMs));
    }
    fmt::print("\n");
  }
}

void printLimits(const BenchLimits& limits) {
  if (!(limits.pixels > 0)) return;
  fmt::print(
      "\nthe device at most, 10^9 a second: fetches {:.3f} nearest, {:.3f} bilinear, {:.3f} trilinear; "
      "pixels {:.3f}; vertices {:.4f}, triangles {:.4f}\n",
      limits.nearestFetches / 1e9, limits.bilinearFetches / 1e9, limits.trilinearFetches / 1e9,
      limits.pixels / 1e9, limits.vertices / 1e9, limits.triangles / 1e9);
}

void printGrowth(const BenchReport& report) {
  for (const BenchGrowth& growth : report.growth) {
    fmt::print("\n{} over {}: frame time grows with exponent {:.2f} +- {:.2f}\n", growth.method, growth.over,
               growth.exponent, growth.exponentError);
    for (const BenchGrowth::Point& point : growth.points) {
      fmt::print("{:>9} {:>16} ms, CPU {:>16} ms;", point.value, pm(point.frame), pm(point.cpuMs));
      for (const BenchPass& pass : point.passes) fmt::print(" {} {:.1f}", pass.name, pass.gpuMs.median);
      fmt::print("\n");
    }
  }
}

void print(const BenchReport& report) {
  fmt::print("{} ({}), {} cores, load {:.1f} to {:.1f}, {}, {} frames after {}; median ~ median deviation\n",
             report.device, report.driver, report.cores, report.load[0], report.load[1], report.date,
             report.frames, report.warmUp);
  printFrames(report);
  printPasses(report);
  printLimits(report.limits);
  printGrowth(report);
}

/// Prints what changed; returns true when something became slower than its noise explains.
bool printRatios(const BenchReport& older, const BenchReport& newer) {
  if (older.device != newer.device)
    fmt::print("\nanother device: {} then, {} now", older.device, newer.device);
  for (const BenchReport* report : {&older, &newer})
    if (report->load[0] >= 1)
      fmt::print("\nother programs were running {} (load {:.1f}): more noise than is seen within a run",
                 report == &older ? "then" : "now", report->load[0]);
  fmt::print("\n{:9} {:9} {:7} {:>9} {:>7}   now over {}\n", "scene", "method", "change", "time", "noise",
             older.date);
  bool worse = false;
  for (const BenchRatio& row : compareBench(older, newer)) {
    fmt::print("{:9} {:9} {:7} {:>9.3f} {:>7.3f}   {}\n", row.scene, row.method, row.change, row.ratio,
               row.noise,
               row.regression()            ? "SLOWER"
               : row.ratio < 1 - row.noise ? "faster"
                                           : "");
    worse = worse || row.regression();
  }
  return worse;
}

int bench(const Flags& flags) {
  const BenchSettings settings = settingsFrom(flags);
  checkFiles(flags);
  std::optional<BenchReport> older;
  if (!flags.compare.empty()) older = readBenchJson(flags.compare);
  const BenchReport report =
      flags.results.empty() ? runBench(settings, terminalProgress()) : readBenchJson(flags.results);
  finishProgress();
  if (!flags.json.empty()) writeTextAtomically(flags.json, benchJson(report));
  print(report);
  if (!older) return 0;
  if (compareBench(*older, report).empty())
    throw Error({.where = flags.compare,
                 .expected = "a row of the same scene, method and settings",
                 .found = "none",
                 .todo = "measure with the same flags"});
  return printRatios(*older, report) ? 1 : 0;
}

}  // namespace

void addBench(CLI::App& app, Action& action) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = app.add_subcommand("bench", "Time whole frames of fixed scenes, pass by pass");
  command->add_option("--methods", flags->methods,
                      "any of fixed,adaptive,matched,volume (adaptive,matched,volume)");
  command->add_option("--scenes", flags->scenes, "any of stone,candle,knot,figurine,bunny,dragon (all)");
  command->add_option(
      "--changes", flags->changes,
      "what changes from frame to frame, any of all,light,camera (all and camera; of volume also light)");
  command->add_flag("--growth", flags->growth,
                    "also cost over resolution, map size, samples, lights and triangles");
  command->add_flag("--limits", flags->limits, "also with --quick: what the device can do at most");
  command->add_option("--models", flags->models, "folder of bunny.ply and dragon.ply")
      ->check(CLI::ExistingDirectory);
  command->add_option("--frames", flags->frames, "measured frames of each row (30; with --quick 5)")
      ->check(CLI::Range(1, 100'000));
  command->add_option("--warm-up", flags->warmUp, "frames before them that do not count (3)")
      ->check(CLI::Range(1, 100'000));
  command->add_flag("--quick", flags->quick, "one scene, 150 x 150, a 256 map");
  command->add_option("--device", flags->device, "auto, gpu, cpu or a number from `lychnite devices`");
  command->add_option("--json", flags->json, "also write the results here");
  command->add_option(
      "--compare", flags->compare,
      "print the times' ratios to these results; status 1 when one is slower beyond the noise");
  command->add_option("--results", flags->results, "take these results instead of measuring");
  command->callback([flags, &action] { action = [flags] { return bench(*flags); }; });
}

}  // namespace lychnite::cli
