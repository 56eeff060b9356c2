#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/paper/chart.h"
#include "app/paper/light_space.h"
#include "app/paper/page.h"
#include "app/paper/report.h"
#include "lychnite/app/paper.h"
#include "lychnite/base/error.h"
#include "lychnite/base/text_file.h"
#include "scratch.h"

namespace lychnite::paper {
namespace {

Table sample() {
  return {.name = "t",
          .caption = "A caption with `code`.",
          .columns = {{"method", "method"}, {"RMSE, %", "rmse", 1, 100}},
          .rows = {{"a, \"b\"", 0.1234}, {"c", std::nan("")}}};
}

TEST(PaperReport, CsvQuotesAndKeepsAllDigits) {
  EXPECT_EQ(csvOf(sample()), "method,rmse\r\n\"a, \"\"b\"\"\",0.1234\r\nc,\r\n");
}

TEST(PaperReport, ShowsInTheColumnsUnit) {
  const Table table = sample();
  EXPECT_EQ(shown(table.rows[0][1], table.columns[1]), "12.3");
  EXPECT_EQ(shown(table.rows[1][1], table.columns[1]), "");
}

TEST(PaperReport, ComesBackFromJson) {
  Report report{.part = "p", .title = "T", .stamp = "s", .seconds = 2, .differs = "d"};
  report.files = {"a.png"};
  report.blocks = {
      Paragraph{"words"}, sample(),
      Gallery{.pictures = {{"a.png", "a.exr", "l", "d"}}, .columns = 2, .cellWidth = 90, .caption = "c"}};
  const Json once = toJson(report);
  EXPECT_EQ(toJson(reportFrom(Json::parse(once.dump()))).dump(), once.dump());
  EXPECT_TRUE(once["blocks"][1]["rows"][1]["rmse"].is_null());
  EXPECT_EQ(once["blocks"][1]["rows"][0]["rmse"], 0.1234);
  EXPECT_THROW(reportFrom(Json::parse("{\"part\": 3}")), Json::exception);
}

TEST(PaperPage, NeedsNoNetworkAndNoScriptAndEscapes) {
  Page page{.version = "1", .date = "d", .device = "<dev & ice>"};
  Report report{.part = "p", .title = "T", .differs = "x < y"};
  report.blocks = {sample(), Gallery{.pictures = {{"a.png", "a.exr", "label", ""}}, .caption = ""}};
  page.reports = {report};
  page.missing = {{"q", "Other"}};
  const std::string html = htmlOf(page);
  EXPECT_EQ(html.find("http"), std::string::npos);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_NE(html.find("&lt;dev &amp; ice&gt;"), std::string::npos);
  EXPECT_NE(html.find("x &lt; y"), std::string::npos);
  EXPECT_NE(html.find("<code>code</code>"), std::string::npos);
  EXPECT_NE(html.find("src=\"p/a.png\""), std::string::npos);
  EXPECT_NE(html.find("href=\"p/t.csv\""), std::string::npos);
  EXPECT_NE(html.find("12.3"), std::string::npos);
  EXPECT_NE(html.find("Other (q)"), std::string::npos);
}

TEST(PaperChart, DrawsEverySeriesInADashOfItsOwn) {
  const ScratchFolder scratch;
  const std::filesystem::path path = scratch / "c.svg";
  Chart chart{.title = "t", .xLabel = "size, mm", .yLabel = "error, %"};
  for (int style = 0; style < 3; ++style)
    chart.series.push_back(
        {.label = "m", .x = {1, 10, 100}, .y = {1, 20, style == 2 ? -1.0 : 50}, .style = style});
  writeChart(chart, path);
  const std::string svg = readText(path);
  EXPECT_EQ(svg.rfind("<?xml", 0), 0u);
  // Style 1 is dashed, 0 and 2 are not; once as a line and once in the legend.
  size_t dashes = 0;
  for (size_t at = svg.find("stroke-dasharray"); at != std::string::npos;
       at = svg.find("stroke-dasharray", at + 1))
    ++dashes;
  EXPECT_GE(dashes, 2u);
  EXPECT_EQ(svg.find("<text"), std::string::npos) << "texts are outlines, the same on every machine";
  EXPECT_THROW(writeChart(chart, scratch / "absent" / "c.svg"), Error);
}

TEST(PaperSettingsCheck, RefusesUnknownPartsAndFolders) {
  EXPECT_THROW(validate(PaperSettings{.only = {"fig2"}}), Error);
  EXPECT_THROW(validate(PaperSettings{.models = "/nonexistent/folder"}), Error);
  EXPECT_NO_THROW(validate(PaperSettings{.only = {"fig6", "table1"}}));
}

}  // namespace
}  // namespace lychnite::paper
