// Table 1: frames per second for the five models.
#include <fmt/format.h>

#include <algorithm>

#include "app/paper/parts.h"
#include "lychnite/app/bench.h"
#include "lychnite/volume/volume.h"

namespace lychnite::paper {
namespace {

/// A row of the paper's table, and what stands for it here.
struct Entry {
  const char* paper;
  double triangles, vertices, framesPerSecond;
  const char* ours;
};
constexpr Entry kEntries[] = {{"Stone", 1114, 802, 255.3, "stone"},
                              {"Candle", 12136, 6936, 142.5, "candle"},
                              {"Aphrodite", 31398, 15701, 105.7, "figurine"},
                              {"Bunny", 69451, 35947, 53.1, "bunny"},
                              {"Dragon", 871414, 437645, 10.3, "dragon"}};

BenchSettings settingsOf(const Studio& studio) {
  BenchSettings settings{.methods = {Method::kAdaptive, Method::kMatched, Method::kVolume},
                         .changes = {"all"},
                         .frames = studio.quick() ? 3 : 15,
                         .warmUp = studio.quick() ? 1 : 3,
                         .quick = studio.quick(),
                         .models = studio.settings().models,
                         .device = studio.settings().device,
                         .log = studio.settings().log};
  for (const Entry& entry : kEntries)
    if (!studio.quick() || entry.triangles < 50000) settings.scenes.emplace_back(entry.ours);
  return settings;
}

Cell rateOf(const BenchReport& bench, const Entry& entry, Method method) {
  for (const BenchRow& row : bench.rows)
    if (row.scene == entry.ours && row.method == methodName(method))
      return row.missing.empty() ? Cell(row.framesPerSecond()) : Cell("");
  return "";
}

const BenchRow* rowOf(const BenchReport& bench, const Entry& entry) {
  const auto row = std::find_if(bench.rows.begin(), bench.rows.end(),
                                [&](const BenchRow& r) { return r.scene == entry.ours; });
  return row == bench.rows.end() ? nullptr : &*row;
}

/// Why a row has no number, or what its stand-in is.
std::string noteOf(const BenchReport& bench, const Entry& entry) {
  const BenchRow* row = rowOf(bench, entry);
  if (!row) return "left out of the quick version";
  if (!row->missing.empty()) return row->missing;
  for (const BenchRow& other : bench.rows)
    if (other.scene == entry.ours && !other.missing.empty()) return other.method + " " + other.missing;
  return std::string(entry.ours) == "bunny" || std::string(entry.ours) == "dragon"
             ? "the same scan"
             : "built-in model of as many triangles";
}

}  // namespace

int speedSteps(const Studio&) {
  return 1;
}

void makeSpeed(Studio& studio, Report& report) {
  const BenchReport bench = runBench(settingsOf(studio), studio.within("frames"));
  studio.step("frames");
  Table table{.name = "frames-per-second",
              .columns = {{"model", "model"},
                          {"triangles, paper", "paper_triangles", 0},
                          {"vertices, paper", "paper_vertices", 0},
                          {"frames/s, paper", "paper_frames_per_second", 1},
                          {"ours", "ours"},
                          {"triangles, ours", "triangles", 0},
                          {"vertices, ours", "vertices", 0},
                          {"adaptive", "adaptive_frames_per_second", 2},
                          {"matched", "matched_frames_per_second", 2},
                          {"volume", "volume_frames_per_second", 2},
                          {"", "note"}}};
  for (const Entry& entry : kEntries) {
    const BenchRow* row = rowOf(bench, entry);
    const bool drawn = row && row->missing.empty();
    table.rows.push_back({entry.paper, entry.triangles, entry.vertices, entry.framesPerSecond, entry.ours,
                          drawn ? Cell(double(row->triangles)) : Cell(""),
                          drawn ? Cell(double(row->vertices)) : Cell(""),
                          rateOf(bench, entry, Method::kAdaptive), rateOf(bench, entry, Method::kMatched),
                          rateOf(bench, entry, Method::kVolume), noteOf(bench, entry)});
  }
  const int side = bench.rows.front().width;
  table.caption = fmt::format(
      "Frames a second. The paper: GeForce 9800 GT, 600 x 600, map 512 x 512. Ours: {}, {} cores, {} x {}, "
      "map {} x {}, "
      "all components, median of {} frames in which light, size and material change each time; `volume` runs "
      "on the CPU "
      "({} cells, no photons), solving and drawing included. Load of the machine {:.1f} before, "
      "{:.1f} after.",
      bench.device, bench.cores, side, side, studio.quick() ? 256 : 512, studio.quick() ? 256 : 512,
      bench.frames, kLiveVolumeCells, bench.load[0], bench.load[1]);
  report.blocks.push_back(table);
  report.differs =
      "The paper's first three models are not to be had: built-in models of the same numbers of triangles "
      "stand "
      "for them. "
      "Triangles and vertices are as drawn, after repair. Other hardware, so the two columns compare "
      "machines as much as "
      "methods; docs/performance.md has the passes.";
}

}  // namespace lychnite::paper
