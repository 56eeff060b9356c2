// lychnite paper: what it writes, that a finished part is kept and an interrupted run goes on, and wrong
// input.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "e2e/runner.h"
#include "lychnite/image/io.h"

namespace lychnite::e2e {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

Result make(const Scratch& scratch, const std::string& parts) {
  return scratch.run({"paper", "--quick", "--only", parts, "-o", "report"});
}

/// Rows of the first table of a part.
Json rowsOf(const Scratch& scratch, const std::string& part) {
  const Json json = Json::parse(scratch.read("report/" + part + "/" + part + ".json"));
  for (const Json& block : json["blocks"])
    if (block.contains("table")) return block["rows"];
  return {};
}

double red(const Json& rows, const std::string& picture) {
  for (const Json& row : rows)
    if (row["picture"] == picture) return row["red"];
  return -1;
}

TEST(Paper, MakesPartsKeepsThemAndAddsToThem) {
  const Scratch scratch;
  const Result first = make(scratch, "fig6,storage");
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(first.err, "");
  EXPECT_NE(first.out.find("2 parts made, 0 kept"), std::string::npos) << first.out;
  for (const char* name :
       {"index.html", "fig6/full.png", "fig6/full.exr", "fig6/components.csv", "storage/storage.csv"})
    EXPECT_TRUE(fs::exists(scratch / "report" / name)) << name;
  const Json rows = rowsOf(scratch, "fig6");
  // Light adds up; the coat only adds.
  const double both = red(rows, "single scattering") + red(rows, "multiple scattering");
  EXPECT_GT(both, 0.1);
  EXPECT_GT(red(rows, "single + multiple + surface"), both);
  EXPECT_LT(red(rows, "single + multiple + surface"), 1.3 * both);
  EXPECT_EQ(readImage(scratch / "report" / "fig6/full.exr").width(), 160);
  // Five channels of 32-bit floats at 512 x 512 with mips: a third more than 5.24 MB.
  EXPECT_NEAR(double(rowsOf(scratch, "storage")[1]["map_bytes"]), 512.0 * 512 * 20 * 4 / 3, 100);
  const auto written = fs::last_write_time(scratch / "report" / "fig6/full.exr");
  const Result again = make(scratch, "fig6,fig4-5");
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.out.find("1 parts made, 1 kept"), std::string::npos) << again.out;
  EXPECT_EQ(fs::last_write_time(scratch / "report" / "fig6/full.exr"), written);
  const std::string page = scratch.read("report/index.html");
  for (const char* id : {"id=\"fig6\"", "id=\"storage\"", "id=\"fig4-5\""})
    EXPECT_NE(page.find(id), std::string::npos) << id;
  // The spiral stands for all light at 1 and 10 mm, the paper's lattice for a fifth of it.
  for (const Json& row : rowsOf(scratch, "fig4-5")) {
    const double flux = row["flux"];
    if (row["pattern"] == "adaptive") {
      EXPECT_LT(flux, 0.4);
    } else if (row["pattern"] == "matched" && double(row["size_mm"]) <= 10) {
      EXPECT_NEAR(flux, 1, 0.06);
    }
  }
}

TEST(Paper, AnOutdatedOrDamagedPartIsMadeAnewFromThePicturesThatStillHold) {
  const Scratch scratch;
  ASSERT_EQ(make(scratch, "fig6").status, 0);
  Json json = Json::parse(scratch.read("report/fig6/fig6.json"));
  const auto written = fs::last_write_time(scratch / "report" / "fig6/full.exr");
  json["stamp"] = "of another program";
  json["files"].push_back("old.png");
  scratch.write("report/fig6/fig6.json", json.dump());
  scratch.write("report/fig6/old.png", "");
  scratch.write("report/fig6/mine.txt", "mine");
  scratch.write("report/fig6/single.exr", "damaged");
  const Result result = make(scratch, "fig6");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("1 parts made, 0 kept"), std::string::npos) << result.out;
  EXPECT_EQ(fs::last_write_time(scratch / "report" / "fig6/full.exr"), written);
  EXPECT_FALSE(fs::exists(scratch / "report" / "fig6/old.png"));
  EXPECT_TRUE(fs::exists(scratch / "report" / "fig6/mine.txt"));
  EXPECT_EQ(readImage(scratch / "report" / "fig6/single.exr").width(), 160);
}

TEST(Paper, AnInterruptedRunGoesOn) {
  const Scratch scratch;
  const Result stopped = scratch.runAndInterrupt({"paper", "--only", "fig6", "-o", "report"}, 0.1);
  expectOneLine(stopped, 130, "goes on");
  EXPECT_FALSE(fs::exists(scratch / "report" / "fig6/fig6.json"));
  EXPECT_EQ(make(scratch, "fig6").status, 0);
  EXPECT_TRUE(fs::exists(scratch / "report" / "fig6/fig6.json"));
}

TEST(Paper, WrongInputIsOneLine) {
  const Scratch scratch;
  scratch.write("file", "");
  expectOneLine(scratch.run({"paper"}), 2, "-o");
  expectOneLine(scratch.run({"paper", "-o", "x", "--only", "fig2"}), 2, "fig1");
  expectOneLine(scratch.run({"paper", "-o", "x", "--models", "absent"}), 2, "absent");
  expectOneLine(scratch.run({"paper", "-o", "file", "--only", "storage"}), 1, "file");
  expectOneLine(scratch.run({"paper", "-o", "/proc/x", "--only", "storage"}), 1, "/proc/x");
  EXPECT_EQ(scratch.names(), std::set<std::string>{"file"});
}

}  // namespace
}  // namespace lychnite::e2e
