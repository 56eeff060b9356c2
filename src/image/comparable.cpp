#include "image/comparable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

void checkColour(const Image& image, const std::string& shownAs) {
  if (!image.hasRgb()) {
    std::string present;
    for (const auto& [name, values] : image.channels()) present += (present.empty() ? "" : ", ") + name;
    throw Error({.where = shownAs,
                 .expected = "channels R, G and B",
                 .found = present.empty() ? "none" : "only " + present,
                 .todo = ""});
  }
  for (const char* channel : {"R", "G", "B"}) checkFinite(image, channel, shownAs);
}

}  // namespace

void checkFinite(const Image& image, const std::string& channel, const std::string& shownAs) {
  const std::vector<float>& values = image.channel(channel);
  const auto bad =
      std::find_if(values.begin(), values.end(), [](float value) { return !std::isfinite(value); });
  if (bad == values.end()) return;
  const auto pixel = size_t(bad - values.begin()), width = size_t(image.width());
  throw Error({.where = shownAs,
               .expected = "finite pixels",
               .found = fmt::format("{} at pixel ({}, {}) of channel {}", *bad, pixel % width, pixel / width,
                                    channel),
               .todo = ""});
}

void checkComparable(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height() || a.empty())
    throw Error({.where = "comparison",
                 .expected = "two pictures of one size",
                 .found = fmt::format("{} x {} and {} x {}", a.width(), a.height(), b.width(), b.height()),
                 .todo = ""});
  checkColour(a, "picture A");
  checkColour(b, "picture B");
  if (b.has("A")) checkFinite(b, "A", "picture B");
}

std::vector<float> coverageOf(const Image& b) {
  if (!b.has("A")) return std::vector<float>(b.pixelCount(), 1);
  std::vector<float> alpha = b.channel("A");
  for (float& value : alpha) value = std::max(value, 0.f);
  if (std::all_of(alpha.begin(), alpha.end(), [](float value) { return value == 0; }))
    throw Error({.where = "picture B", .expected = "an object", .found = "alpha 0 everywhere", .todo = ""});
  return alpha;
}

double meanColour(const Image& b, const std::vector<float>& weights) {
  double sum = 0, weight = 0;
  for (const char* channel : {"R", "G", "B"}) {
    const std::vector<float>& values = b.channel(channel);
    for (size_t i = 0; i < values.size(); ++i) {
      sum += double(weights[i]) * double(values[i]);
      weight += double(weights[i]);
    }
  }
  if (!(sum > 0))
    throw Error({.where = "picture B",
                 .expected = "a picture that is not black, to measure against",
                 .found = fmt::format("a mean of {}", sum / weight),
                 .todo = ""});
  return sum / weight;
}

}  // namespace lychnite
