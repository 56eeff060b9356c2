#include "lychnite/app/follow_pace.h"

#include <gtest/gtest.h>

namespace lychnite {
namespace {

const int kPictures[3] = {};

TEST(FollowPace, FollowsWhilePicturesKeepComing) {
  FollowPace pace;
  for (int i = 0; i < 40; ++i) EXPECT_TRUE(pace.follows(&kPictures[i / 5 % 2], true, 0.1 * i)) << i;
}

TEST(FollowPace, GivesUpOnASlowSceneAndTriesAgainMuchLater) {
  FollowPace pace;
  EXPECT_TRUE(pace.follows(kPictures, true, 0));
  EXPECT_TRUE(pace.follows(kPictures, true, 0.5));
  EXPECT_FALSE(pace.follows(kPictures, true, 0.7));
  EXPECT_FALSE(pace.follows(kPictures + 1, false, 1));
  EXPECT_FALSE(pace.follows(kPictures + 2, true, 2));
  EXPECT_TRUE(pace.follows(kPictures + 2, false, 0.7 + FollowPace::kRetryAfter));
}

TEST(FollowPace, TheTimeThatTheSceneRestedIsNoLag) {
  FollowPace pace;
  EXPECT_TRUE(pace.follows(kPictures, false, 0));
  EXPECT_TRUE(pace.follows(kPictures, true, 100));
  EXPECT_TRUE(pace.follows(kPictures, true, 100.5));
  EXPECT_FALSE(pace.follows(kPictures, true, 100.7));
}

TEST(FollowPace, PicturesAreAsCoarseAsTheyMustBe) {
  FollowPace pace;
  pace.measured(0.01, 1);
  EXPECT_EQ(pace.share(), 1);
  pace.measured(3.4 * FollowPace::kPictureSeconds, 1);
  EXPECT_EQ(pace.share(), 0.5);  // .85 of it
  pace.measured(0.85 * FollowPace::kPictureSeconds, 0.5);
  EXPECT_EQ(pace.share(), 0.5);
  pace.measured(100, 0.5);
  EXPECT_EQ(pace.share(), 0.25);
  // A little faster is not yet a reason to grow.
  pace.measured(FollowPace::kPictureSeconds * 0.25 * 0.25 / (0.375 * 0.375), 0.25);
  EXPECT_EQ(pace.share(), 0.25);
}

}  // namespace
}  // namespace lychnite
