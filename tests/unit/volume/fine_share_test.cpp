#include <gtest/gtest.h>

#include <cmath>

#include "volume/radiosity.h"

namespace lychnite::volume {
namespace {

TEST(FineShare, IsAllOfALocalResponseAndNothingOfAWideOne) {
  const glm::vec3 share = fineShare(
      [](double q, int c) { return c == 0    ? 0.5
                                   : c == 1  ? 0.8 * std::exp(-q)
                                   : q < 0.3 ? 0.9
                                             : 0.0; }, 2);
  EXPECT_NEAR(share.r, 0.5, 1e-6);
  EXPECT_GT(share.g, 0.01);
  EXPECT_LT(share.g, 0.3);
  EXPECT_NEAR(share.b, 0, 1e-3);
  EXPECT_EQ(fineShare([](double q, int) { return q < 0.3 ? 0.9 : 0.0; }, 2), glm::vec3(0));
}

TEST(FineShare, FallsAsTheResponseWidens) {
  float before = 1;
  for (const double width : {0.0, 0.1, 0.3, 1.0, 3.0}) {
    const float share = fineShare([&](double q, int) { return 0.7 * std::exp(-width * q); }, 1).r;
    EXPECT_LT(share, before) << width;
    before = share;
  }
  EXPECT_NEAR(fineShare([](double q, int) { return 0.7 * std::exp(-0.001 * q); }, 10).r, 0.7, 0.01);
}

TEST(FineShare, IsNotNegativeInAnyChannel) {
  const glm::vec3 share = fineShare([](double, int c) { return c == 1 ? -0.2 : 0.3; }, 1);
  EXPECT_NEAR(share.r, 0.3, 1e-6);
  EXPECT_EQ(share.g, 0);
}

TEST(FineShare, IsNoSharperThanWhatThePictureShows) {
  const auto response = [](double q, int) { return 0.7 * std::exp(-0.3 * q); };
  for (const double finest : {4.0, 8.0, 15.0})
    EXPECT_LE(fineShare(response, finest).r, float(response(finest, 0)) + 1e-6f) << finest;
  EXPECT_GT(fineShare(response, 1).r, fineShare(response, 8).r);
}

}  // namespace
}  // namespace lychnite::volume
