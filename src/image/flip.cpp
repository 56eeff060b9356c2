// LDR-FLIP after Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild 2020, "FLIP: A
// Difference Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2). Section
// numbers are the paper's; the constants are those of its reference implementation (BSD-3,
// github.com/NVlabs/flip), none of whose code is here.
#include "image/flip.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace lychnite {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPixelsPerDegree = 0.7 * (3840 / 0.7) * (kPi / 180);

// Exponents and the knee of the error redistribution.
constexpr double kQc = 0.7, kQf = 0.5, kPc = 0.4, kPt = 0.95;
// Width in degrees of the edge detector of human vision.
constexpr double kFeatureWidth = 0.082;

/// Linear sRGB to XYZ (rows as written in IEC 61966-2-1, as exact fractions; glm wants columns).
const glm::dmat3 kXyzFromRgb =
    glm::transpose(glm::dmat3(10135552. / 24577794, 8788810. / 24577794, 4435075. / 24577794,  //
                              2613072. / 12288897, 8788810. / 12288897, 887015. / 12288897,    //
                              1425312. / 73733382, 8788810. / 73733382, 70074185. / 73733382));
const glm::dmat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);
/// The D65 white of the same fractions, R = G = B = 1.
const glm::dvec3 kWhite = kXyzFromRgb * glm::dvec3(1);

/// Spatial filtering: the linear opponent space YyCxCz of the contrast sensitivity filters.
glm::dvec3 opponentFromRgb(const glm::dvec3& rgb) {
  const glm::dvec3 xyz = kXyzFromRgb * rgb / kWhite;
  return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)};
}

glm::dvec3 rgbFromOpponent(const glm::dvec3& opponent) {
  const double y = (opponent.x + 16) / 116;
  return kRgbFromXyz * (glm::dvec3(y + opponent.y / 500, y, y - opponent.z / 200) * kWhite);
}

double labCurve(double t) {
  constexpr double kDelta = 6. / 29;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4. / 29;
}

/// Perceptually uniform colour space: CIELAB with a* and b* scaled by 0.01 L* (the Hunt effect).
glm::dvec3 huntLabFromRgb(const glm::dvec3& rgb) {
  const glm::dvec3 xyz = kXyzFromRgb * rgb / kWhite;
  const glm::dvec3 f(labCurve(xyz.x), labCurve(xyz.y), labCurve(xyz.z));
  const double lightness = 116 * f.y - 16;
  return {lightness, 0.01 * lightness * 500 * (f.x - f.y), 0.01 * lightness * 200 * (f.y - f.z)};
}

/// Colour metric: the HyAB distance, city-block in lightness and Euclidean in chroma.
double hyab(const glm::dvec3& p, const glm::dvec3& q) {
  return std::abs(p.x - q.x) + std::hypot(p.y - q.y, p.z - q.z);
}

/// Colour metric: compresses large differences; the largest (green against blue) gives 1.
double redistribute(double distance) {
  static const double largest = std::pow(hyab(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1})), kQc);
  const double error = std::pow(distance, kQc), knee = kPc * largest;
  if (error < knee) return kPt / knee * error;
  return kPt + (error - knee) / (largest - knee) * (1 - kPt);
}

/// One Gaussian a sqrt(pi/b) exp(-pi^2 d^2 / b) of a contrast sensitivity function, d in degrees.
struct CsfTerm {
  double a, b;

  double sigma() const { return std::sqrt(b / 2) / kPi * kPixelsPerDegree; }  ///< in pixels
};

/// The kernels share the radius of the widest (b = 0.04), three standard deviations.
Plane blur(const Plane& plane, const CsfTerm& term) {
  static const int radius = int(std::ceil(3 * CsfTerm{1, 0.04}.sigma()));
  const std::vector<float> kernel = gaussianKernel(term.sigma(), radius);
  return filter(plane, kernel, kernel);
}

/// Weight of one term among several: its sum over the pixels of the (cut off) two-dimensional kernel.
double weightOf(const CsfTerm& term, int radius) {
  double sum = 0;
  for (int x = -radius; x <= radius; ++x) sum += std::exp(-x * x / (2 * term.sigma() * term.sigma()));
  return term.a * std::sqrt(kPi / term.b) * sum * sum;
}

/// Spatial filtering: what is left of the opponent channels at this distance.
void filterByContrastSensitivity(std::array<Plane, 3>& opponent) {
  constexpr CsfTerm kAchromatic{1, 0.0047}, kRedGreen{1, 0.0053},
      kBlueYellow[] = {{34.1, 0.04}, {13.5, 0.025}};
  opponent[0] = blur(opponent[0], kAchromatic);
  opponent[1] = blur(opponent[1], kRedGreen);
  const int radius = int(std::ceil(3 * kBlueYellow[0].sigma()));
  const double wide = weightOf(kBlueYellow[0], radius), narrow = weightOf(kBlueYellow[1], radius);
  const Plane second = blur(opponent[2], kBlueYellow[1]);
  opponent[2] = blur(opponent[2], kBlueYellow[0]);
  for (size_t i = 0; i < second.values.size(); ++i)
    opponent[2].values[i] =
        float((wide * opponent[2].values[i] + narrow * second.values[i]) / (wide + narrow));
}

glm::dvec3 at(const std::array<Plane, 3>& planes, size_t i) {
  return {planes[0].values[i], planes[1].values[i], planes[2].values[i]};
}

std::array<Plane, 3> opponentPlanes(const std::array<Plane, 3>& rgb) {
  std::array<Plane, 3> opponent = rgb;
  for (size_t i = 0; i < rgb[0].values.size(); ++i) {
    const glm::dvec3 value = opponentFromRgb(at(rgb, i));
    for (int c = 0; c < 3; ++c) opponent[size_t(c)].values[i] = float(value[c]);
  }
  return opponent;
}

/// The colour as perceived at pixel i of filtered opponent planes, first clamped to what the display can
/// show.
glm::dvec3 perceived(const std::array<Plane, 3>& filtered, size_t i) {
  return huntLabFromRgb(glm::clamp(rgbFromOpponent(at(filtered, i)), 0., 1.));
}

/// Scales the positive weights to the sum 1 and the negative ones to -1.
std::vector<float> balanced(const std::vector<double>& weights) {
  double positive = 0, negative = 0;
  for (const double weight : weights) (weight > 0 ? positive : negative) += std::abs(weight);
  std::vector<float> kernel;
  for (const double weight : weights) kernel.push_back(float(weight / (weight > 0 ? positive : negative)));
  return kernel;
}

/// Feature detection: strength of edges and of points at every pixel of the (unfiltered) achromatic channel.
std::array<std::vector<float>, 2> features(const Plane& achromatic) {
  const double sigma = 0.5 * kFeatureWidth * kPixelsPerDegree;
  const int radius = int(std::ceil(3 * sigma));
  std::vector<double> first, second;
  for (int x = -radius; x <= radius; ++x) {
    const double gaussian = std::exp(-x * x / (2 * sigma * sigma));
    first.push_back(-x * gaussian);
    second.push_back((x * x / (sigma * sigma) - 1) * gaussian);
  }
  Plane luminance = achromatic;
  for (float& value : luminance.values) value = (value + 16) / 116;
  const std::vector<float> smooth = gaussianKernel(sigma, radius);
  std::array<std::vector<float>, 2> strengths;
  const std::array kernels = {balanced(first), balanced(second)};
  for (size_t k = 0; k < kernels.size(); ++k) {
    const Plane x = filter(luminance, kernels[k], smooth), y = filter(luminance, smooth, kernels[k]);
    for (size_t i = 0; i < x.values.size(); ++i) strengths[k].push_back(std::hypot(x.values[i], y.values[i]));
  }
  return strengths;
}

}  // namespace

std::vector<float> flipDifference(const std::array<Plane, 3>& test, const std::array<Plane, 3>& reference) {
  std::array<Plane, 3> a = opponentPlanes(test), b = opponentPlanes(reference);
  const auto featuresA = features(a[0]), featuresB = features(b[0]);
  filterByContrastSensitivity(a);
  filterByContrastSensitivity(b);
  std::vector<float> difference(a[0].values.size());
  for (size_t i = 0; i < difference.size(); ++i) {
    const double colour = redistribute(hyab(perceived(a, i), perceived(b, i)));
    const double feature =
        std::max(std::abs(featuresA[0][i] - featuresB[0][i]), std::abs(featuresA[1][i] - featuresB[1][i]));
    // Feature metric and final difference: a change of features raises the colour difference.
    difference[i] = float(std::pow(colour, 1 - std::pow(feature / std::numbers::sqrt2, kQf)));
  }
  return difference;
}

}  // namespace lychnite
