#include "lychnite/image/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

TEST(Image, ChannelsStartAtZeroAndKeepWhatIsSet) {
  Image image(3, 2);
  EXPECT_EQ(image.pixelCount(), 6u);
  EXPECT_FALSE(image.hasRgb());
  EXPECT_EQ(image.addChannel("A"), std::vector<float>(6, 0));
  image.addChannel("A")[4] = 0.5f;
  EXPECT_EQ(image.addChannel("A")[4], 0.5f) << "adding again must not clear";
  image.setRgb(5, {1, 2, 3});
  image.setRgb(0, {4, 5, 6}, "single");
  EXPECT_EQ(image.rgb(5), glm::vec3(1, 2, 3));
  EXPECT_EQ(image.rgb(0, "single"), glm::vec3(4, 5, 6));
  EXPECT_EQ(image.channel("single.G")[0], 5);
  EXPECT_TRUE(image.hasRgb());
  EXPECT_TRUE(image.hasRgb("single"));
}

TEST(Image, AMissingChannelIsNamedWithThoseThatAreThere) {
  Image image(1, 1);
  image.addChannel("depth.Z");
  try {
    image.channel("R");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("'R'"), testing::HasSubstr("depth.Z")));
  }
}

}  // namespace
}  // namespace lychnite
