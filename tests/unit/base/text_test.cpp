#include "lychnite/base/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lychnite {
namespace {

using testing::ElementsAre;

TEST(Split, KeepsEmptyParts) {
  EXPECT_THAT(split("a,b", ','), ElementsAre("a", "b"));
  EXPECT_THAT(split("a,,b", ','), ElementsAre("a", "", "b"));
  EXPECT_THAT(split(",", ','), ElementsAre("", ""));
  EXPECT_THAT(split("", ','), ElementsAre(""));
  EXPECT_THAT(split("plain", ','), ElementsAre("plain"));
}

TEST(NearestName, FindsWhatWasMeant) {
  const std::vector<std::string> names{"marble", "skin1", "skin2", "wholemilk"};
  EXPECT_EQ(nearestName("marbel", names), "marble");
  EXPECT_EQ(nearestName("MARBLE", names), "marble");
  EXPECT_EQ(nearestName("skin", names), "skin1");
  EXPECT_EQ(nearestName("whole", names), "wholemilk");
}

TEST(NearestName, StaysSilentWhenNothingIsNear) {
  const std::vector<std::string> names{"marble", "wholemilk"};
  EXPECT_EQ(nearestName("xyz", names), "");
  EXPECT_EQ(nearestName("concrete", names), "");
  EXPECT_EQ(nearestName("marble", std::vector<std::string>{}), "");
}

TEST(TomlString, EscapesWhatTomlWould) {
  EXPECT_EQ(tomlString("a \"b\" \\ c"), "\"a \\\"b\\\" \\\\ c\"");
  EXPECT_EQ(tomlString("x\ny"), "\"x\\u000ay\"");
}

}  // namespace
}  // namespace lychnite
