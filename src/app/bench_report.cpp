#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lychnite/app/bench.h"
#include "lychnite/base/error.h"

namespace lychnite {
namespace {

using Json = nlohmann::ordered_json;

// Of normally scattered values, 1.4826 median deviations are one standard deviation.
constexpr double kDeviationsOfNormal = 1.4826;
// Two of them, and what clocks and caches differ by from run to run even on a machine with nothing else to
// do.
constexpr double kNoise = 2 * kDeviationsOfNormal, kLeastNoise = 0.02;

double medianOf(std::vector<double>& values) {
  const size_t half = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + long(half), values.end());
  const double upper = values[half];
  if (values.size() % 2 == 1) return upper;
  return (*std::max_element(values.begin(), values.begin() + long(half)) + upper) / 2;
}

Json toJson(const Statistic& s) {
  return {{"median", s.median}, {"deviation", s.deviation}};
}

Statistic statisticFrom(const Json& json) {
  return {json.at("median"), json.at("deviation")};
}

Json toJson(const std::vector<BenchPass>& passes) {
  Json json = Json::array();
  for (const BenchPass& pass : passes) json.push_back({{"name", pass.name}, {"gpu_ms", toJson(pass.gpuMs)}});
  return json;
}

std::vector<BenchPass> passesFrom(const Json& json) {
  std::vector<BenchPass> passes;
  for (const Json& pass : json) passes.push_back({pass.at("name"), statisticFrom(pass.at("gpu_ms"))});
  return passes;
}

Json toJson(const BenchLimits& limits) {
  return {{"nearest_fetches_per_second", limits.nearestFetches},
          {"bilinear_fetches_per_second", limits.bilinearFetches},
          {"trilinear_fetches_per_second", limits.trilinearFetches},
          {"pixels_per_second", limits.pixels},
          {"vertices_per_second", limits.vertices},
          {"triangles_per_second", limits.triangles}};
}

BenchLimits limitsFrom(const Json& json) {
  return {json.at("nearest_fetches_per_second"),   json.at("bilinear_fetches_per_second"),
          json.at("trilinear_fetches_per_second"), json.at("pixels_per_second"),
          json.at("vertices_per_second"),          json.at("triangles_per_second")};
}

Json toJson(const BenchGrowth& growth) {
  Json json{{"over", growth.over},
            {"method", growth.method},
            {"exponent", growth.exponent},
            {"exponent_se", growth.exponentError},
            {"points", Json::array()}};
  for (const BenchGrowth::Point& point : growth.points)
    json["points"].push_back({{"value", point.value},
                              {"frame_ms", toJson(point.frame)},
                              {"cpu_ms", toJson(point.cpuMs)},
                              {"passes", toJson(point.passes)}});
  return json;
}

BenchGrowth growthFrom(const Json& json) {
  BenchGrowth growth{.over = json.at("over"), .method = json.at("method")};
  growth.exponent = json.at("exponent");
  growth.exponentError = json.at("exponent_se");
  for (const Json& point : json.at("points"))
    growth.points.push_back({point.at("value"), statisticFrom(point.at("frame_ms")),
                             statisticFrom(point.at("cpu_ms")), passesFrom(point.at("passes"))});
  return growth;
}

Json toJson(const BenchRow& row) {
  Json json{{"scene", row.scene}, {"method", row.method}, {"change", row.change}};
  if (!row.missing.empty()) {
    json["missing"] = row.missing;
    return json;
  }
  json.update({{"width", row.width},
               {"height", row.height},
               {"map_size", row.mapSize},
               {"samples", row.samples},
               {"single_samples", row.singleSamples},
               {"triangles", row.triangles},
               {"vertices", row.vertices},
               {"covered_pixels", row.coveredPixels},
               {"map_bytes", row.mapBytes},
               {"gpu_bytes", row.gpuBytes},
               {"memory_bytes", row.memoryBytes},
               {"moved_bytes", row.movedBytes},
               {"frames_per_second", row.framesPerSecond()},
               {"frame_ms", toJson(row.frame)},
               {"cpu_ms", toJson(row.cpuMs)}});
  json["passes"] = toJson(row.passes);
  json["all_frames_ms"] = row.frameMs;
  return json;
}

BenchRow rowFrom(const Json& json) {
  BenchRow row;
  row.scene = json.at("scene");
  row.method = json.at("method");
  row.change = json.at("change");
  if (json.contains("missing")) {
    row.missing = json.at("missing");
    return row;
  }
  row.width = json.at("width");
  row.height = json.at("height");
  row.mapSize = json.at("map_size");
  row.samples = json.at("samples");
  row.singleSamples = json.at("single_samples");
  row.triangles = json.at("triangles");
  row.vertices = json.at("vertices");
  row.coveredPixels = json.at("covered_pixels");
  row.mapBytes = json.at("map_bytes");
  row.gpuBytes = json.at("gpu_bytes");
  row.memoryBytes = json.value("memory_bytes", size_t(0));
  row.movedBytes = json.value("moved_bytes", size_t(0));
  row.frame = statisticFrom(json.at("frame_ms"));
  row.cpuMs = statisticFrom(json.at("cpu_ms"));
  row.passes = passesFrom(json.at("passes"));
  row.frameMs = json.at("all_frames_ms").get<std::vector<double>>();
  return row;
}

BenchReport reportFrom(const Json& json) {
  BenchReport report;
  report.version = json.at("lychnite");
  report.date = json.at("date");
  report.device = json.at("device");
  report.driver = json.at("driver");
  report.software = json.at("software");
  report.cores = json.at("cores");
  report.load = json.at("load").get<std::array<double, 2>>();
  report.frames = json.at("frames");
  report.warmUp = json.at("warm_up");
  for (const Json& row : json.at("rows")) report.rows.push_back(rowFrom(row));
  if (json.contains("limits")) report.limits = limitsFrom(json.at("limits"));
  if (json.contains("growth"))
    for (const Json& growth : json.at("growth")) report.growth.push_back(growthFrom(growth));
  return report;
}

bool sameWork(const BenchRow& a, const BenchRow& b) {
  return a.scene == b.scene && a.method == b.method && a.change == b.change && a.width == b.width &&
         a.height == b.height && a.mapSize == b.mapSize && a.samples == b.samples &&
         a.singleSamples == b.singleSamples && a.missing.empty() && b.missing.empty();
}

}  // namespace

Statistic statisticOf(std::vector<double> values) {
  if (values.empty()) return {};
  Statistic result;
  result.median = medianOf(values);
  for (double& value : values) value = std::abs(value - result.median);
  result.deviation = medianOf(values);
  return result;
}

std::string benchJson(const BenchReport& report) {
  Json json{{"lychnite", report.version}, {"date", report.date},         {"device", report.device},
            {"driver", report.driver},    {"software", report.software}, {"cores", report.cores},
            {"load", report.load},        {"frames", report.frames},     {"warm_up", report.warmUp},
            {"rows", Json::array()}};
  for (const BenchRow& row : report.rows) json["rows"].push_back(toJson(row));
  if (report.limits.pixels > 0) json["limits"] = toJson(report.limits);
  for (const BenchGrowth& growth : report.growth) json["growth"].push_back(toJson(growth));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

BenchReport readBenchJson(const std::filesystem::path& path) {
  const auto refuse = [&](std::string found) {
    throw Error({.where = path.string(),
                 .expected = "results of `lychnite bench --json`",
                 .found = std::move(found),
                 .todo = ""});
  };
  std::ifstream file(path);
  if (!file) refuse("no file that can be read");
  try {
    return reportFrom(Json::parse(file));
  } catch (const Json::parse_error& error) {
    refuse(fmt::format("no JSON (byte {})", error.byte));
  } catch (const Json::exception& error) {
    refuse(error.what());
  }
  return {};
}

std::vector<BenchRatio> compareBench(const BenchReport& older, const BenchReport& newer) {
  std::vector<BenchRatio> result;
  for (const BenchRow& now : newer.rows) {
    const auto before = std::find_if(older.rows.begin(), older.rows.end(),
                                     [&](const BenchRow& row) { return sameWork(row, now); });
    if (before == older.rows.end()) continue;
    std::vector<double> ratios;
    for (size_t i = 0; i < std::min(now.frameMs.size(), before->frameMs.size()); ++i)
      if (before->frameMs[i] > 0) ratios.push_back(now.frameMs[i] / before->frameMs[i]);
    if (ratios.empty()) continue;
    const Statistic ratio = statisticOf(std::move(ratios));
    result.push_back(
        {now.scene, now.method, now.change, ratio.median, std::max(kLeastNoise, kNoise * ratio.deviation)});
  }
  return result;
}

}  // namespace lychnite
