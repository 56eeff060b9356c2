#include "golden.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "lychnite/image/io.h"

namespace lychnite {
namespace {

namespace fs = std::filesystem;

/// At the rim a geometry sample may fall the other way on another rasteriser: a quarter of the pixel, or two.
constexpr double kRim = 0.55;

float asHalf(float value) {
  int exponent = 0;
  const float mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::round(mantissa * 2048) / 2048, exponent);
}

std::vector<std::string> channelsOf(const std::vector<std::string>& layers) {
  std::vector<std::string> names{"A"};
  for (const std::string& layer : layers)
    for (const char* c : {"R", "G", "B"}) names.push_back(layer.empty() ? c : layer + "." + c);
  return names;
}

Image selected(const Image& image, const std::vector<std::string>& channels) {
  Image result(image.width(), image.height());
  for (const std::string& name : channels) {
    std::vector<float>& to = result.addChannel(name);
    std::transform(image.channel(name).begin(), image.channel(name).end(), to.begin(), asHalf);
  }
  return result;
}

/// Fully covered, with all of its eight neighbours.
bool isInside(const Image& image, int x, int y) {
  if (x < 1 || y < 1 || x + 1 >= image.width() || y + 1 >= image.height()) return false;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (image.channel("A")[size_t(y + dy) * size_t(image.width()) + size_t(x + dx)] < 1) return false;
  return true;
}

struct Errors {
  double inside = 0, rim = 0, mean = 0;
};

/// Mean over the covered pixels.
double meanOf(const Image& image, const std::string& channel) {
  double sum = 0, covered = 1e-12;
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    sum += double(image.channel(channel)[i]);
    covered += image.channel("A")[i] > 0 ? 1 : 0;
  }
  return sum / covered;
}

Errors errorsOf(const Image& result, const Image& golden, const std::string& channel) {
  const auto &a = result.channel(channel), &b = golden.channel(channel);
  const double mean = std::max(1e-12, meanOf(golden, channel));
  Errors errors;
  for (int y = 0; y < golden.height(); ++y)
    for (int x = 0; x < golden.width(); ++x) {
      const size_t i = size_t(y) * size_t(golden.width()) + size_t(x);
      const double difference = std::isfinite(a[i]) ? std::abs(double(a[i]) - double(b[i])) : INFINITY;
      const double e = difference / std::max(mean, double(b[i]));
      errors.mean += e / double(golden.pixelCount());
      double& largest = isInside(golden, x, y) ? errors.inside : errors.rim;
      largest = std::max(largest, e);
    }
  return errors;
}

void writeFailure(const std::string& name, const Image& result, const Image& golden) {
  const fs::path folder = LYCHNITE_TEST_OUTPUT_DIR;
  fs::create_directories(folder);
  Image difference = result;
  for (const auto& [channel, values] : golden.channels()) {
    std::vector<float>& to = difference.addChannel(channel);
    for (size_t i = 0; i < to.size(); ++i) to[i] -= values[i];
  }
  writeExr(result, folder / (name + "-result.exr"));
  writeExr(golden, folder / (name + "-reference.exr"));
  writeExr(difference, folder / (name + "-difference.exr"));
  ADD_FAILURE() << "see " << name << "-{result,reference,difference}.exr in " << folder;
}

}  // namespace

void expectGolden(const std::string& name, const Image& image, const std::vector<std::string>& layers,
                  const GoldenBounds& bounds) {
  const fs::path path = fs::path(LYCHNITE_SOURCE_DIR) / "tests/golden" / (name + ".exr");
  const std::vector<std::string> channels = channelsOf(layers);
  const Image result = selected(image, channels);
  const char* update = std::getenv("LYCHNITE_UPDATE_GOLDENS");
  if (update && std::string(update) == "1") {
    writeExr(result, path);
    GTEST_SKIP() << "wrote " << path;
  }
  const Image golden = readImage(path);
  ASSERT_EQ(golden.width(), result.width());
  ASSERT_EQ(golden.height(), result.height());
  bool good = true;
  for (const std::string& channel : channels) {
    ASSERT_TRUE(golden.has(channel)) << channel;
    const Errors errors = errorsOf(result, golden, channel);
    EXPECT_LE(errors.inside, bounds.inside) << channel << ": " << bounds.reason;
    EXPECT_LE(errors.rim, kRim) << channel;
    EXPECT_LE(errors.mean, bounds.mean) << channel << ": " << bounds.reason;
    good = good && errors.inside <= bounds.inside && errors.rim <= kRim && errors.mean <= bounds.mean;
  }
  if (!good) writeFailure(name, result, golden);
}

}  // namespace lychnite
