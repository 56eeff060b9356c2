#include "gpu/texture.h"

#include <cmath>
#include <vector>

#include "gpu_test.h"

namespace lychnite::gpu {
namespace {

struct FormatCase {
  Format format;
  int channels;
  size_t bytes;
  float tolerance;  ///< relative; half a unit in the last place, or a whole one where a driver truncates
};

void PrintTo(const FormatCase& c, std::ostream* out) {
  *out << "format " << static_cast<int>(c.format);
}

class FormatTest : public GpuTest, public ::testing::WithParamInterface<FormatCase> {};

TEST_P(FormatTest, UploadComesBackWithinTheFormatsPrecision) {
  const FormatCase& c = GetParam();
  EXPECT_EQ(channels(c.format), c.channels);
  EXPECT_EQ(texelBytes(c.format), c.bytes);
  Texture texture({.label = "t", .format = c.format, .width = 5, .height = 3, .levels = 2});
  for (int level = 0; level < 2; ++level) {
    std::vector<float> values(static_cast<size_t>(texture.width(level)) * texture.height(level) * c.channels);
    for (size_t i = 0; i < values.size(); ++i) values[i] = 0.01f + static_cast<float>(i) / 61.0f;
    texture.upload(values, level);
    const std::vector<float> back = texture.download(level);
    ASSERT_EQ(back.size(), values.size());
    for (size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(back[i], values[i], c.tolerance * std::max(values[i], 0.25f)) << level << " " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(All, FormatTest,
                         ::testing::Values(FormatCase{Format::kRgba8, 4, 4, 4.0f / 255},
                                           FormatCase{Format::kR16f, 1, 2, 1.0f / 1024},
                                           FormatCase{Format::kRg16f, 2, 4, 1.0f / 1024},
                                           FormatCase{Format::kRgba16f, 4, 8, 1.0f / 1024},
                                           FormatCase{Format::kR32f, 1, 4, 0},
                                           FormatCase{Format::kRg32f, 2, 8, 0},
                                           FormatCase{Format::kRgba32f, 4, 16, 0},
                                           FormatCase{Format::kDepth32f, 1, 4, 0}));

using TextureTest = GpuTest;

TEST_F(TextureTest, FloatsKeepTheirRange) {
  Texture texture({.label = "t", .format = Format::kR32f, .width = 4, .height = 1});
  const std::vector<float> values{-1e30f, 1e-30f, 0, 70000};
  texture.upload(values);
  EXPECT_EQ(texture.download(), values);
}

TEST_F(TextureTest, IntegersComeBackExactly) {
  Texture texture({.label = "t", .format = Format::kR32ui, .width = 2, .height = 2});
  const std::vector<uint32_t> values{0, 1, 0x80000001u, 0xffffffffu};
  texture.upload(values);
  EXPECT_EQ(texture.downloadUint(), values);
}

TEST_F(TextureTest, MipLevelsAreMeans) {
  Texture texture({.label = "t", .format = Format::kRg32f, .width = 8, .height = 4, .levels = 0});
  ASSERT_EQ(texture.levels(), 4);
  std::vector<float> values(2 * 8 * 4);
  double sum = 0;
  for (int i = 0; i < 32; ++i) {
    values[2 * i] = static_cast<float>((i * 7) % 11);
    values[2 * i + 1] = 1000.0f + static_cast<float>(i);
    sum += values[2 * i];
  }
  texture.upload(values);
  texture.generateMipmaps();
  const std::vector<float> one = texture.download(1);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) {
      const auto at = [&](int dx, int dy) { return values[2 * ((2 * y + dy) * 8 + 2 * x + dx)]; };
      EXPECT_FLOAT_EQ(one[2 * (y * 4 + x)], (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) / 4) << x << " " << y;
    }
  const std::vector<float> top = texture.download(3);
  ASSERT_EQ(top.size(), 2u);
  EXPECT_NEAR(top[0], sum / 32, 1e-5);
  EXPECT_FLOAT_EQ(top[1], 1015.5f);
}

TEST_F(TextureTest, FullLevelsReachOneTexel) {
  EXPECT_EQ(fullLevels(1, 1), 1);
  EXPECT_EQ(fullLevels(512, 512), 10);
  EXPECT_EQ(fullLevels(300, 7), 9);
}

TEST_F(TextureTest, TooLargeIsAnErrorThatNamesTheLimit) {
  const int tooLarge = maxTextureSize() + 1;
  const Error::Parts parts =
      errorOf([&] { Texture({.label = "map", .format = Format::kR32f, .width = tooLarge, .height = 1}); });
  EXPECT_EQ(parts.where, "texture 'map'");
  EXPECT_NE(parts.expected.find(std::to_string(maxTextureSize())), std::string::npos) << parts.expected;
  const Error::Parts samples =
      errorOf([] { Texture({.label = "many", .width = 4, .height = 4, .samples = 1000}); });
  EXPECT_NE(samples.found.find("1000 samples"), std::string::npos) << samples.found;
  EXPECT_EQ(allocatedBytes(), 0u);
}

}  // namespace
}  // namespace lychnite::gpu
