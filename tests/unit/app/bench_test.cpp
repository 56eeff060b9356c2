#include "lychnite/app/bench.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

BenchRow row(const std::string& scene, std::vector<double> frames) {
  BenchRow result{.scene = scene, .method = "matched", .change = "all"};
  result.width = result.height = 600;
  result.mapSize = 512;
  result.samples = 32;
  result.singleSamples = 8;
  result.frame = statisticOf(frames);
  result.frameMs = std::move(frames);
  return result;
}

BenchReport reportOf(std::vector<BenchRow> rows) {
  BenchReport report;
  report.rows = std::move(rows);
  return report;
}

BenchRatio onlyRatio(const std::vector<double>& older, const std::vector<double>& newer) {
  const auto ratios = compareBench(reportOf({row("stone", older)}), reportOf({row("stone", newer)}));
  EXPECT_EQ(ratios.size(), 1u);
  return ratios.empty() ? BenchRatio{} : ratios.front();
}

class BenchFile : public testing::Test {
 protected:
  BenchFile() : path_(testing::TempDir() + "bench_" + std::to_string(getpid()) + ".json") {}
  ~BenchFile() override { std::filesystem::remove(path_); }
  void write(const std::string& text) const { std::ofstream(path_) << text; }
  void expectRefused(const std::string& text, const std::string& words) const {
    write(text);
    try {
      readBenchJson(path_);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Kind::kInput);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  std::filesystem::path path_;
};

TEST(BenchStatistic, MedianAndDeviationIgnoreOneOutlier) {
  const Statistic odd = statisticOf({900, 3, 1, 2, 4});  // distances to 3: 897, 0, 2, 1, 1
  EXPECT_EQ(odd.median, 3);
  EXPECT_EQ(odd.deviation, 1);
  const Statistic evenCount = statisticOf({8, 1, 2, 4});  // distances to 3: 5, 2, 1, 1
  EXPECT_EQ(evenCount.median, 3);
  EXPECT_EQ(evenCount.deviation, 1.5);
  const Statistic one = statisticOf({7});
  EXPECT_EQ(one.median, 7);
  EXPECT_EQ(one.deviation, 0);
  EXPECT_EQ(statisticOf({}).median, 0);
}

TEST(BenchGrowth, FitsTheExponentAndItsError) {
  BenchGrowth growth;
  for (const double value : {1.0, 2.0, 4.0, 8.0})
    growth.points.push_back({value, {3 * std::pow(value, 1.5), 0}, {}, {}});
  fitExponent(growth);
  EXPECT_NEAR(growth.exponent, 1.5, 1e-12);
  EXPECT_NEAR(growth.exponentError, 0, 1e-7);
  // ln y off by +d, -d, -d, +d at ln x = 0, l, 2l, 3l: the slope stays, its error is sqrt(4 d^2 / 2 / (5
  // l^2)).
  const double d = 0.1, l = std::log(2.0);
  const double signs[] = {1, -1, -1, 1};
  for (size_t i = 0; i < 4; ++i) growth.points[i].frame.median *= std::exp(signs[i] * d);
  fitExponent(growth);
  EXPECT_NEAR(growth.exponent, 1.5, 1e-12);
  EXPECT_NEAR(growth.exponentError, std::sqrt(2 * d * d / (5 * l * l)), 1e-9);
  growth.points.resize(1);
  fitExponent(growth);
  EXPECT_EQ(growth.exponent, 0);
}

TEST(BenchCompare, DividesEachFrameByItself) {
  // Frames of very different work, each half as slow again: no noise at all beyond the least.
  const BenchRatio slower = onlyRatio({10, 100, 40, 20}, {15, 150, 60, 30});
  EXPECT_DOUBLE_EQ(slower.ratio, 1.5);
  EXPECT_DOUBLE_EQ(slower.noise, 0.02);
  EXPECT_TRUE(slower.regression());
}

TEST(BenchCompare, ASlowdownWithinTheNoiseIsNoRegression) {
  // Ratios 0.8, 1.1, 1.4: median 1.1, deviation 0.3.
  const BenchRatio noisy = onlyRatio({10, 10, 10}, {8, 11, 14});
  EXPECT_DOUBLE_EQ(noisy.ratio, 1.1);
  EXPECT_NEAR(noisy.noise, 2 * 1.4826 * 0.3, 1e-12);
  EXPECT_FALSE(noisy.regression());
  EXPECT_FALSE(onlyRatio({10, 10, 10}, {10, 10, 10}).regression());
  EXPECT_FALSE(onlyRatio({10, 10, 10}, {5, 5, 5}).regression());
  EXPECT_FALSE(onlyRatio({10, 10, 10}, {10.1, 10.1, 10.1}).regression());
  EXPECT_TRUE(onlyRatio({10, 10, 10}, {10.3, 10.3, 10.3}).regression());
  // Ratios 1.4, 1.5, 1.6: far beyond their scatter.
  EXPECT_TRUE(onlyRatio({10, 10, 10}, {14, 15, 16}).regression());
}

TEST(BenchCompare, UsesTheFramesThatBothHave) {
  EXPECT_DOUBLE_EQ(onlyRatio({10, 20}, {20, 40, 1, 1, 1}).ratio, 2);
}

TEST(BenchCompare, OnlyTheSameWork) {
  BenchRow smaller = row("stone", {1}), missing = row("bunny", {});
  smaller.width = 150;
  missing.missing = "no bunny.ply";
  const BenchReport newer = reportOf({row("stone", {1}), row("bunny", {1})});
  EXPECT_TRUE(compareBench(reportOf({smaller, missing, row("knot", {1})}), newer).empty());
}

TEST_F(BenchFile, RoundTrip) {
  BenchReport report = reportOf({row("stone", {10.25, 12.5, 11.125}), {}});
  report.version = "0.1.0";
  report.date = "2026-11-22";
  report.device = "a \"device\"";
  report.driver = "4.5";
  report.software = true;
  report.cores = 2;
  report.load = {0.5, 1.25};
  report.frames = 3;
  report.warmUp = 4;
  BenchRow& full = report.rows[0];
  full.triangles = 12;
  full.vertices = 8;
  full.coveredPixels = 99;
  full.mapBytes = 1u << 20;
  full.gpuBytes = 1u << 22;
  full.cpuMs = {20.5, 0.25};
  full.passes = {{"light_map", {1.5, 0.125}}, {"multiple", {7, 2}}};
  report.rows[1].scene = "dragon";
  report.rows[1].missing = "needs --models";
  const std::string text = benchJson(report);
  write(text);
  const BenchReport back = readBenchJson(path_);
  EXPECT_EQ(benchJson(back), text);
  EXPECT_EQ(back.device, report.device);
  EXPECT_EQ(back.load, report.load);
  ASSERT_EQ(back.rows.size(), 2u);
  EXPECT_EQ(back.rows[0].frameMs, full.frameMs);
  EXPECT_EQ(back.rows[0].frame.median, 11.125);
  EXPECT_EQ(back.rows[0].frame.deviation, 0.875);
  EXPECT_EQ(back.rows[0].passes[1].name, "multiple");
  EXPECT_EQ(back.rows[0].passes[1].gpuMs.deviation, 2);
  EXPECT_EQ(back.rows[0].coveredPixels, 99u);
  EXPECT_EQ(back.rows[1].missing, "needs --models");
}

TEST_F(BenchFile, WhatIsNoneIsRefused) {
  EXPECT_THROW(readBenchJson(path_.string() + ".none"), Error);
  expectRefused("not json", "no JSON");
  expectRefused("{}", "lychnite");
  expectRefused("[1, 2]", path_.string());
  std::string text = benchJson(reportOf({row("stone", {1})}));
  text.replace(text.find("\"triangles\": 0"), 14, "\"triangles\": {}");
  expectRefused(text, "number");
}

TEST(BenchSettings, OutOfRange) {
  const auto refused = [](auto change) {
    BenchSettings settings;
    change(settings);
    EXPECT_THROW(validate(settings), Error);
  };
  EXPECT_NO_THROW(validate(BenchSettings{}));
  refused([](BenchSettings& s) { s.methods.clear(); });
  refused([](BenchSettings& s) { s.methods = {Method::kWalk}; });
  refused([](BenchSettings& s) { s.methods = {Method::kHierarchical}; });
  refused([](BenchSettings& s) { s.frames = 0; });
  refused([](BenchSettings& s) { s.warmUp = 0; });
  refused([](BenchSettings& s) { s.models = "no/such/folder"; });
}

}  // namespace
}  // namespace lychnite
