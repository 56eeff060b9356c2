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
  std::vector<Method> methods{Method::kAdaptive, Method::kMatched};  ///< of fixed, adaptive, matched, volume
  std::vector<std::string> scenes;   ///< empty: stone, candle, knot, figurine, bunny, dragon (quick: stone)
  std::vector<std::string> changes;  ///< empty: "all" and "camera", of volume also "light"
  int frames = 30;                   ///< measured frames of each row, 1..100000
  int warmUp = 3;                    ///< frames before them that do not count, at least 1
  bool quick = false;                ///< one scene, 150 x 150, a 256 map
  bool limits = false;               ///< also what the device can do at most
  bool growth = false;           ///< also cost against resolution, map size, samples, lights and triangles
  std::filesystem::path models;  ///< folder of bunny.ply and dragon.ply; empty: none
  std::string device = "auto";   ///< as RendererOptions::device
  LogSink log;
};
/// Throws Error (Kind::kUsage): numbers out of range, a judge, an unknown scene or change, no folder.
void validate(const BenchSettings& settings);

struct BenchPass {
  std::string name;
  Statistic
      gpuMs;  ///< by the device's timer (of volume: the wall's clock); 0 in frames that did not need the pass
};

/// One scene by one method under one kind of change.
struct BenchRow {
  std::string scene, method;
  /// "all": light, size and material are others in each frame; "light", "camera": only it turns.
  std::string change;
  std::string missing;  ///< why nothing was measured and what to do; then all below is 0
  int width = 0, height = 0, mapSize = 0;
  int samples = 0, singleSamples = 0;  ///< asked for, a pixel and light
  size_t triangles = 0, vertices = 0;
  size_t coveredPixels = 0;                            ///< in the first warm-up frame
  size_t mapBytes = 0, gpuBytes = 0, memoryBytes = 0;  ///< the last: of volume, on the CPU
  size_t movedBytes = 0;        ///< read and written in a frame, had nothing a cache (docs/performance.md)
  std::vector<double> frameMs;  ///< wall time of each frame, from the call until the device is done
  Statistic frame, cpuMs;       ///< of frameMs; of this process's CPU time on all cores, a frame
  std::vector<BenchPass> passes;
  double framesPerSecond() const { return frame.median > 0 ? 1000 / frame.median : 0; }
};

/// What the device can do at most, measured by kernels that do nothing else. Per second; 0: not measured.
struct BenchLimits {
  double nearestFetches = 0;           ///< texelFetch of RGBA32F, 512 x 512, neighbours to neighbours
  double bilinearFetches = 0;          ///< textureLod at a whole level of the same
  double trilinearFetches = 0;         ///< textureLod between two levels
  double pixels = 0;                   ///< written to RGBA32F
  double vertices = 0, triangles = 0;  ///< of a mesh of a million triangles, all off the picture
};

/// Cost of one thing that grows, all else fixed.
struct BenchGrowth {
  std::string over;  ///< "lines", "map_size", "samples", "lights" or "triangles"
  std::string method;
  struct Point {
    double value = 0;
    Statistic frame, cpuMs;
    std::vector<BenchPass> passes;
  };
  std::vector<Point> points;
  /// Of frame time ~ value^exponent, least squares in the logarithms, and its standard error.
  double exponent = 0, exponentError = 0;
};
/// Fits the exponent to the points; 0 for fewer than two.
void fitExponent(BenchGrowth& growth);

struct BenchReport {
  std::string version, date, device, driver;
  bool software = false;
  int cores = 0;
  std::array<double, 2> load{0,
                             0};  ///< the machine's load over the minute before the begin and before the end
  int frames = 0, warmUp = 0;
  std::vector<BenchRow> rows;
  BenchLimits limits;
  std::vector<BenchGrowth> growth;
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
