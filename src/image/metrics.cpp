#include "lychnite/image/metrics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "image/comparable.h"
#include "image/filter.h"
#include "image/flip.h"
#include "lychnite/base/error.h"
#include "lychnite/image/tone_map.h"

namespace lychnite {
namespace {

constexpr std::array kColours = {"R", "G", "B"};

struct Channel {
  const std::vector<float>* a;
  const std::vector<float>* b;
  const std::vector<float>* standardError;  ///< of B, or nullptr
};

/// Weighted sums over the pixels of the channels that are pooled.
struct Sums {
  double weight = 0, a = 0, b = 0, aa = 0, ab = 0, noise = 0;
};

Sums sumsOf(std::span<const Channel> channels, const std::vector<float>& weights) {
  Sums sums;
  for (const Channel& channel : channels)
    for (size_t i = 0; i < weights.size(); ++i) {
      const double w = weights[i], a = (*channel.a)[i], b = (*channel.b)[i];
      const double noise = channel.standardError ? (*channel.standardError)[i] : 0;
      sums.weight += w;
      sums.a += w * a;
      sums.b += w * b;
      sums.aa += w * a * a;
      sums.ab += w * a * b;
      sums.noise += w * noise * noise;
    }
  return sums;
}

/// Root mean square of gain * A - B. B = truth + noise, independent of A, so E (A - B)^2 = (A - truth)^2 +
/// noise variance: taking out the mean variance leaves an unbiased mean square.
double rmse(std::span<const Channel> channels, const std::vector<float>& weights, const Sums& sums,
            double gain) {
  double squares = 0;
  for (const Channel& channel : channels)
    for (size_t i = 0; i < weights.size(); ++i) {
      const double error = gain * double((*channel.a)[i]) - double((*channel.b)[i]);
      squares += double(weights[i]) * error * error;
    }
  return std::sqrt(std::max(0., (squares - sums.noise) / sums.weight));
}

/// `meanOfAll` stands in for the mean of a channel in which B is black.
Metrics linearMetrics(std::span<const Channel> channels, const std::vector<float>& weights,
                      double meanOfAll) {
  const Sums sums = sumsOf(channels, weights);
  const double own = sums.b / sums.weight, mean = own > 0 ? own : meanOfAll;
  Metrics metrics;
  metrics.relative_rmse = rmse(channels, weights, sums, 1) / mean;
  metrics.bias = (sums.a - sums.b) / sums.weight / mean;
  metrics.best_gain = sums.aa > 0 ? sums.ab / sums.aa : 1;
  metrics.relative_rmse_after_gain = rmse(channels, weights, sums, metrics.best_gain) / mean;
  return metrics;
}

using Display = std::array<Plane, 3>;

Display displayOf(const Image& image, double exposure) {
  Display display;
  for (size_t c = 0; c < 3; ++c) display[c] = {image.width(), image.height(), image.channel(kColours[c])};
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    const glm::vec3 linear(display[0].values[i], display[1].values[i], display[2].values[i]);
    const glm::vec3 value = toneMap(linear, {.curve = ToneMapping::Curve::kSrgb, .exposure = exposure});
    for (size_t c = 0; c < 3; ++c) display[c].values[i] = value[int(c)];
  }
  return display;
}

/// FLIP's own first step undoes the sRGB curve.
Display linearised(Display display) {
  for (Plane& plane : display)
    for (float& value : plane.values) value = linearFromSrgb(value);
  return display;
}

double meanSquare(const Plane& a, const Plane& b) {
  double sum = 0;
  for (size_t i = 0; i < a.values.size(); ++i) sum += std::pow(double(a.values[i]) - double(b.values[i]), 2);
  return sum / double(a.values.size());
}

double decibels(double meanSquareError) {
  return -10 * std::log10(meanSquareError);
}

Plane product(const Plane& p, const Plane& q) {
  Plane result = p;
  for (size_t i = 0; i < result.values.size(); ++i) result.values[i] *= q.values[i];
  return result;
}

/// Wang, Bovik, Sheikh & Simoncelli 2004, eq. 13, averaged over the windows that lie inside the picture (eq.
/// 17), as in the authors' program; in a direction shorter than the window, over all with the edge repeated.
double ssim(const Plane& a, const Plane& b) {
  constexpr int kRadius = 5;
  constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
  const std::vector<float> window = gaussianKernel(1.5, kRadius);
  const auto mean = [&](const Plane& plane) { return filter(plane, window, window).values; };
  const auto meanA = mean(a), meanB = mean(b);
  const auto meanAA = mean(product(a, a)), meanBB = mean(product(b, b)), meanAB = mean(product(a, b));
  const int marginX = a.width > 2 * kRadius ? kRadius : 0, marginY = a.height > 2 * kRadius ? kRadius : 0;
  double sum = 0;
  for (int y = marginY; y < a.height - marginY; ++y)
    for (int x = marginX; x < a.width - marginX; ++x) {
      const size_t i = size_t(y) * size_t(a.width) + size_t(x);
      const double ma = meanA[i], mb = meanB[i];
      const double varianceA = meanAA[i] - ma * ma, varianceB = meanBB[i] - mb * mb,
                   covariance = meanAB[i] - ma * mb;
      sum += (2 * ma * mb + kC1) * (2 * covariance + kC2) /
             ((ma * ma + mb * mb + kC1) * (varianceA + varianceB + kC2));
    }
  return sum / (double(a.width - 2 * marginX) * double(a.height - 2 * marginY));
}

/// Rec. 709 luma of display values.
Plane luma(const Display& display) {
  Plane result = display[0];
  for (size_t i = 0; i < result.values.size(); ++i)
    result.values[i] =
        0.2126f * display[0].values[i] + 0.7152f * display[1].values[i] + 0.0722f * display[2].values[i];
  return result;
}

void addDisplayMetrics(const Image& a, const Image& b, double exposure, Comparison& comparison) {
  const Display shownA = displayOf(a, exposure), shownB = displayOf(b, exposure);
  double pooled = 0;
  for (size_t c = 0; c < 3; ++c) {
    const double square = meanSquare(shownA[c], shownB[c]);
    pooled += square / 3;
    comparison.channels[c].psnr = decibels(square);
    comparison.channels[c].ssim = ssim(shownA[c], shownB[c]);
  }
  comparison.together.psnr = decibels(pooled);
  comparison.together.ssim = ssim(luma(shownA), luma(shownB));
  const std::vector<float> flip = flipDifference(linearised(shownA), linearised(shownB));
  comparison.flip = std::accumulate(flip.begin(), flip.end(), 0.) / double(flip.size());
}

void checkStandardError(const Image& b) {
  if (!b.hasRgb("stderr"))
    throw Error({.where = "picture B",
                 .expected = "a standard-error layer (stderr.R, stderr.G, stderr.B)",
                 .found = "none",
                 .todo = "render it with --method walk to EXR, or compare without its standard error"});
  for (const char* colour : kColours) checkFinite(b, std::string("stderr.") + colour, "picture B");
}

}  // namespace

Comparison compare(const Image& a, const Image& b, const CompareOptions& options) {
  checkComparable(a, b);
  if (options.useStandardError) checkStandardError(b);
  const std::vector<float> weights = coverageOf(b);
  const double mean = meanColour(b, weights);
  std::array<Channel, 3> channels{};
  for (size_t c = 0; c < 3; ++c) {
    const std::string colour = kColours[c];
    channels[c] = {&a.channel(colour), &b.channel(colour),
                   options.useStandardError ? &b.channel("stderr." + colour) : nullptr};
  }
  Comparison comparison;
  comparison.together = linearMetrics(channels, weights, mean);
  for (size_t c = 0; c < 3; ++c) comparison.channels[c] = linearMetrics({&channels[c], 1}, weights, mean);
  comparison.pixels = size_t(std::count_if(weights.begin(), weights.end(), [](float w) { return w > 0; }));
  addDisplayMetrics(a, b, options.exposure, comparison);
  return comparison;
}

std::vector<float> flipMap(const Image& a, const Image& b, double exposure) {
  checkComparable(a, b);
  return flipDifference(linearised(displayOf(a, exposure)), linearised(displayOf(b, exposure)));
}

}  // namespace lychnite
