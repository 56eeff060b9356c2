#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "lychnite/base/log.h"
#include "lychnite/base/progress.h"
#include "lychnite/scene/settings.h"

namespace lychnite {

// The whole-frame benchmark behind `lychnite bench` (docs/performance.md).

/// A middle and how far values lie from it.
struct Statistic {
  double median = 0;
  double deviation = 0;  ///< median of the absolute distances to the median
};
/// Zeros for no value at all.
Statistic statisticOf(std::vector<double> values);

struct BenchSettings {
  std::vector<Method> methods{Method::kAdaptive, Method::kMatched};  ///< of fixed, adaptive, matched
  int frames = 30;               ///< measured frames of each row, 1..100000
  int warmUp = 3;                ///< frames before them that do not count, at least 1
  bool quick = false;            ///< one scene, 150 x 150, a 256 map
  std::filesystem::path models;  ///< folder of bunny.ply and dragon.ply; empty: none
  std::string device = "auto";   ///< as RendererOptions::device
  LogSink log;
};
/// Throws Error (Kind::kUsage): numbers out of range, a method that is not drawn by the Renderer, no folder.
void validate(const BenchSettings& settings);

struct BenchPass {
  std::string name;
  Statistic gpuMs;  ///< by the device's timer; 0 in frames that did not need the pass
};

/// One scene by one method under one kind of change.
struct BenchRow {
  std::string scene, method;
  std::string change;   ///< "all": light, size and material are others in each frame; "camera": only it turns
  std::string missing;  ///< why nothing was measured and what to do; then all below is 0
  int width = 0, height = 0, mapSize = 0;
  int samples = 0, singleSamples = 0;  ///< asked for, a pixel and light
  size_t triangles = 0, vertices = 0;
  size_t coveredPixels = 0;  ///< in the first warm-up frame
  size_t mapBytes = 0, gpuBytes = 0;
  std::vector<double> frameMs;  ///< wall time of each frame, from the call until the device is done
  Statistic frame, cpuMs;       ///< of frameMs; of this process's CPU time on all cores, a frame
  std::vector<BenchPass> passes;
  double framesPerSecond() const { return frame.median > 0 ? 1000 / frame.median : 0; }
};

struct BenchReport {
  std::string version, date, device, driver;
  bool software = false;
  int cores = 0;
  std::array<double, 2> load{0,
                             0};  ///< the machine's load over the minute before the begin and before the end
  int frames = 0, warmUp = 0;
  std::vector<BenchRow> rows;
};

/// Measures. Throws Error, and Interrupted when `progress` says stop.
BenchReport runBench(const BenchSettings& settings, const Progress& progress = {});

/// The text of docs/user/machine-output.md, and back. Throws Error for a file that is missing or not one.
std::string benchJson(const BenchReport& report);
BenchReport readBenchJson(const std::filesystem::path& path);

/// How a row's frames changed. Frame i does the same work in every run, so each is divided by itself.
struct BenchRatio {
  std::string scene, method, change;
  double ratio = 1;  ///< new time over old, median over the frames that both have
  double noise =
      0;  ///< two standard deviations of the frames' ratios (from their median deviation), 2 % at least
  bool regression() const { return ratio > 1 + noise; }
};
/// Of the rows that both reports have at the same resolution, map and samples.
std::vector<BenchRatio> compareBench(const BenchReport& older, const BenchReport& newer);

}  // namespace lychnite
