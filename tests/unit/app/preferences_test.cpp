#include "lychnite/app/preferences.h"

#include <gtest/gtest.h>

#include <fstream>

#include "scratch.h"

namespace lychnite {
namespace {

namespace fs = std::filesystem;

LogSink collect(std::vector<std::string>& lines) {
  return [&lines](LogLevel, std::string_view text) { lines.emplace_back(text); };
}

TEST(Preferences, ComeBackAsTheyWere) {
  const ScratchFolder scratch;
  const fs::path path = scratch / "deep/folder/viewer.toml";
  Preferences kept{
      .windowWidth = 900, .windowHeight = 700, .panelWidth = 400, .ruler = false, .walkThreads = 3};
  kept.addRecent("/a/b \"c\".ply");
  kept.addRecent("/d\\e.glb");
  std::vector<std::string> log;
  writePreferences(kept, path, collect(log));
  EXPECT_EQ(readPreferences(path, collect(log)), kept);
  EXPECT_TRUE(log.empty());
}

TEST(Preferences, AreDefaultsWhereThereAreNone) {
  std::vector<std::string> log;
  EXPECT_EQ(readPreferences("/nonexistent/viewer.toml", collect(log)), Preferences{});
  EXPECT_EQ(readPreferences("", collect(log)), Preferences{});
  EXPECT_TRUE(log.empty());
}

TEST(Preferences, BrokenOnesAreSetAside) {
  for (const char* text :
       {"window_width = [", "window_width = 3", "recent = 5", "ruler = 1", "panel_width = nan"}) {
    const ScratchFolder scratch;
    const fs::path path = scratch / "viewer.toml";
    std::ofstream(path) << text;
    std::vector<std::string> log;
    EXPECT_EQ(readPreferences(path, collect(log)), Preferences{}) << text;
    ASSERT_EQ(log.size(), 1u) << text;
    EXPECT_NE(log.front().find("viewer.toml.broken"), std::string::npos) << log.front();
    EXPECT_FALSE(fs::exists(path));
    EXPECT_TRUE(fs::exists(path.string() + ".broken"));
  }
}

TEST(Preferences, WhatCannotBeWrittenIsAWarning) {
  const ScratchFolder scratch;
  std::ofstream(scratch / "file") << "x";
  std::vector<std::string> log;
  writePreferences({}, scratch / "file/viewer.toml", collect(log));
  EXPECT_EQ(log.size(), 1u);
}

TEST(Preferences, RecentFilesAreFewAndNewestFirst) {
  Preferences preferences;
  for (int i = 0; i < 30; ++i) preferences.addRecent("/" + std::to_string(i % 12));
  EXPECT_EQ(preferences.recent.size(), Preferences::kMostRecent);
  EXPECT_EQ(preferences.recent.front(), "/5");
}

}  // namespace
}  // namespace lychnite
