// lychnite bench: what it writes, and what it makes of older results. No time is judged, only the verdict on
// times that are written here.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "e2e/runner.h"

namespace lychnite::e2e {
namespace {

using Json = nlohmann::json;

Result measure(const Scratch& scratch, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"bench", "--quick", "--frames", "2", "--warm-up", "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return scratch.run(arguments);
}

/// The results in `name` with all frames `factor` times as long.
std::string scaled(const Scratch& scratch, const std::string& name, double factor) {
  Json json = Json::parse(scratch.read(name));
  for (Json& row : json["rows"]) {
    row["frame_ms"]["median"] = factor * double(row["frame_ms"]["median"]);
    for (Json& ms : row["all_frames_ms"]) ms = factor * double(ms);
  }
  return json.dump();
}

double passMs(const Json& row, const std::string& name) {
  for (const Json& pass : row["passes"])
    if (pass["name"] == name) return pass["gpu_ms"]["median"];
  return -1;
}

TEST(Bench, MeasuresAndWrites) {
  const Scratch scratch;
  const Result result = measure(scratch, {"--methods", "adaptive,matched", "--json", "b.json"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("light_map"), std::string::npos);
  EXPECT_EQ(scratch.names(), std::set<std::string>{"b.json"});
  const Json json = Json::parse(scratch.read("b.json"));
  EXPECT_NE(json["device"], "");
  ASSERT_EQ(json["rows"].size(), 4u);  // two methods, two kinds of change
  for (const Json& row : json["rows"]) {
    EXPECT_EQ(row["scene"], "stone");
    EXPECT_EQ(row["all_frames_ms"].size(), 2u);
    EXPECT_GT(double(row["frame_ms"]["median"]), 0);
    EXPECT_GT(double(row["cpu_ms"]["median"]), 0);
    EXPECT_GT(int(row["triangles"]), 1000);
    // A round thing in a square picture: less than the disc of pi/4, more than a quarter.
    EXPECT_GT(int(row["covered_pixels"]), 150 * 150 / 4);
    EXPECT_LT(int(row["covered_pixels"]), 150 * 150 * 4 / 5);
    EXPECT_GT(int(row["map_bytes"]), 256 * 256);
    EXPECT_GT(passMs(row, "multiple"), 0);
    if (row["change"] == "camera")
      EXPECT_EQ(passMs(row, "light_map"), 0) << "the light stands still";
    else
      EXPECT_GT(passMs(row, "light_map"), 0);
  }
}

TEST(Bench, TimesVolumeAndGrowthAndTheDevice) {
  const Scratch scratch;
  const Result result = measure(scratch, {"--methods", "adaptive,volume", "--changes", "light", "--growth",
                                          "--limits", "--json", "b.json"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("exponent"), std::string::npos);
  const Json json = Json::parse(scratch.read("b.json"));
  ASSERT_EQ(json["rows"].size(), 2u);
  const Json& volume = json["rows"][1];
  EXPECT_EQ(volume["method"], "volume");
  EXPECT_GT(passMs(volume, "source"), 0) << "the light has moved";
  EXPECT_GT(passMs(volume, "solve"), 0);
  EXPECT_GT(int(volume["memory_bytes"]), 100'000);
  EXPECT_GT(int(json["rows"][0]["moved_bytes"]), 150 * 150 * 16);
  for (const auto& [name, rate] : json["limits"].items()) EXPECT_GT(double(rate), 1e3) << name;
  std::set<std::string> over;
  for (const Json& growth : json["growth"]) {
    over.insert(growth["over"]);
    ASSERT_GE(growth["points"].size(), 2u);
    EXPECT_TRUE(std::isfinite(double(growth["exponent"])));
    for (const Json& point : growth["points"]) EXPECT_GT(double(point["frame_ms"]["median"]), 0);
  }
  EXPECT_EQ(over,
            (std::set<std::string>{"lines", "map_size", "lights", "triangles"}));  // samples: of matched
}

TEST(Bench, ComparesWithOlderResults) {
  const Scratch scratch;
  ASSERT_EQ(measure(scratch, {"--methods", "adaptive", "--json", "b.json"}).status, 0);
  scratch.write("fast.json", scaled(scratch, "b.json", 0.1));
  scratch.write("slow.json", scaled(scratch, "b.json", 1000));
  const auto against = [&](const std::string& older) {
    return scratch.run({"bench", "--results", "b.json", "--compare", older});
  };
  const Result same = against("b.json");
  EXPECT_EQ(same.status, 0) << same.err;
  EXPECT_NE(same.out.find(" 1.000 "), std::string::npos) << same.out;
  const Result slower = against("fast.json");
  EXPECT_EQ(slower.status, 1);
  EXPECT_NE(slower.out.find("10.000"), std::string::npos) << slower.out;
  EXPECT_NE(slower.out.find("SLOWER"), std::string::npos);
  EXPECT_EQ(against("slow.json").status, 0);
  EXPECT_EQ(measure(scratch, {"--methods", "adaptive", "--compare", "slow.json"}).status, 0);
  expectOneLine(
      scratch.run({"bench", "--quick", "--frames", "1", "--methods", "fixed", "--compare", "b.json"}), 1,
      "b.json");
}

TEST(Bench, FilesThatAreNoResults) {
  const Scratch scratch;
  scratch.write("bad.json", "{\"rows\": 3}");
  scratch.write("none.json", "no json");
  for (const char* flag : {"--compare", "--results"}) {
    for (const char* name : {"bad.json", "none.json", "absent.json"}) {
      const Result result = scratch.run({"bench", "--quick", flag, name});
      expectOneLine(result, 1, name);
      EXPECT_EQ(result.out, "");
    }
  }
}

}  // namespace
}  // namespace lychnite::e2e
