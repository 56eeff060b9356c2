#include "lychnite/base/error.h"

#include <gtest/gtest.h>

#include "lychnite/base/log.h"
#include "lychnite/base/progress.h"

namespace lychnite {
namespace {

TEST(Error, IsOneLineOfFourParts) {
  const Error error({.where = "a.toml:3", .expected = "a length", .found = "'x'", .todo = "write 20mm"});
  EXPECT_STREQ(error.what(), "a.toml:3: expected a length, found 'x'; write 20mm");
  EXPECT_EQ(error.kind(), Error::Kind::kInput);
  EXPECT_EQ(error.parts().found, "'x'");
}

TEST(Error, LeavesOutEmptyParts) {
  EXPECT_STREQ(Error({.where = "w", .expected = "e"}).what(), "w: expected e");
  EXPECT_STREQ(Error({.where = "w", .found = "f"}).what(), "w: f");
  EXPECT_STREQ(Error({.where = "w", .todo = "t"}).what(), "w; t");
  EXPECT_STREQ(Error({.expected = "e", .found = "f"}).what(), "expected e, found f");
  EXPECT_STREQ(Error({.found = "f", .todo = "t"}).what(), "f; t");
  EXPECT_STREQ(Error({}).what(), "");
}

TEST(Error, FoldsLineBreaks) {
  EXPECT_STREQ(Error({.where = "a\nb", .found = "c\r\nd"}).what(), "a b: c  d");
}

TEST(Progress, EmptyOneNeverStops) {
  const Progress progress;
  EXPECT_TRUE(progress.update({.what = "walk"}));
  EXPECT_NO_THROW(progress.check({.what = "walk"}));
}

TEST(Progress, ReportsAndStops) {
  std::string seen;
  double fraction = 0;
  const Progress progress([&](const Progress::Update& update) {
    seen = std::string(update.what) + "/" + update.detail;
    fraction = update.fraction;
    return update.fraction < 0.5;
  });
  EXPECT_TRUE(progress.update({.what = "walk", .fraction = 0.25, .detail = "1/4"}));
  EXPECT_EQ(seen, "walk/1/4");
  EXPECT_EQ(fraction, 0.25);
  EXPECT_NO_THROW(progress.check({.what = "walk", .fraction = 0.25}));
  EXPECT_FALSE(progress.update({.what = "walk", .fraction = 0.75}));
  EXPECT_THROW(progress.check({.what = "walk", .fraction = 0.75}), Interrupted);
}

TEST(LogTo, PassesOnOrStaysSilent) {
  std::string seen;
  LogLevel level = LogLevel::kDebug;
  logTo(
      [&](LogLevel l, std::string_view text) {
        level = l;
        seen = text;
      },
      LogLevel::kWarning, "open mesh");
  EXPECT_EQ(seen, "open mesh");
  EXPECT_EQ(level, LogLevel::kWarning);
  EXPECT_NO_THROW(logTo({}, LogLevel::kInfo, "nobody listens"));
}

}  // namespace
}  // namespace lychnite
