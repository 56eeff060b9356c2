#include "volume/slab_transport.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lychnite/optics/fresnel.h"

namespace lychnite::volume {

namespace {

constexpr int kCells = 96;
constexpr int kSteps = 32;            // of an integral over a beam
constexpr int kDirections = 8;        // of each of the two ranges of cosines: mirrored in full, and not
constexpr float kDeepest = 8.0f / 9;  // depth z over 1 + z
constexpr double kThinnest = 0.05, kThickest = 16;

using Column = std::array<double, kCells>;

struct Direction {
  double cosine, weight, reflectance;
};

/// Nodes and weights of Gauss & Legendre on [low, high], by Newton's method.
void addDirections(double low, double high, double eta, std::vector<Direction>& to) {
  constexpr int n = kDirections;
  for (int i = 0; i < n && high > low; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int round = 0; round < 8; ++round) {
      double before = 1, p = x;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    const double cosine = low + 0.5 * (high - low) * (1 + x);
    to.push_back({cosine, (high - low) / ((1 - x * x) * slope * slope), fresnelReflectance(cosine, 1 / eta)});
  }
}

/// Ends of the layers of a slab, thin near its sides.
double edgeOf(double thickness, int i) {
  const double x = double(i) / kCells;
  return thickness * x * x * (3 - 2 * x);
}

double leastCosineOut(double eta) {
  return eta > 1 ? std::sqrt(1 - 1 / (eta * eta)) : 0;
}

std::vector<Direction> directionsOf(double eta) {
  std::vector<Direction> result;
  const double least = leastCosineOut(eta);
  addDirections(0, least, eta, result);
  addDirections(least, 1, eta, result);
  return result;
}

/// A slab cut into layers that are thin near its sides; lengths in mean free paths.
class Slab {
 public:
  Slab(double thickness, double albedo, const std::vector<Direction>& directions);

  /// Share of the first collisions of a beam, none mirrored, that leaves by the side it came in by.
  double reflected(double cosine) const;
  /// Share of what is emitted at a depth, in all directions, that leaves by the first side.
  double leaving(double depth) const;

 private:
  /// Shares of light along one direction that pass whole layers.
  struct Passing {
    Column pass;         ///< a layer
    Column first, last;  ///< of what a layer emits evenly, to the first and to the last side
    double all = 1;
  };
  Passing passing(double cosine) const;
  void addFlights(const Direction& direction);
  void solve(double albedo);

  Column width_;
  Column middle_;
  Column leaving_{};             ///< by the first side, of what each layer emits evenly
  std::vector<Column> flights_;  ///< from each layer to each other one
};

Slab::Slab(double thickness, double albedo, const std::vector<Direction>& directions)
    : flights_(kCells, Column{}) {
  for (int i = 0; i < kCells; ++i)
    width_[size_t(i)] = edgeOf(thickness, i + 1) - edgeOf(thickness, i),
    middle_[size_t(i)] = 0.5 * (edgeOf(thickness, i + 1) + edgeOf(thickness, i));
  for (const Direction& direction : directions) addFlights(direction);
  solve(albedo);
}

Slab::Passing Slab::passing(double cosine) const {
  Passing p;
  Column half;
  for (size_t i = 0; i < kCells; ++i) {
    const double x = width_[i] / cosine;
    p.pass[i] = std::exp(-x);
    half[i] = -std::expm1(-x) / x;
  }
  double way = 1;
  for (size_t i = 0; i < kCells; ++i) p.first[i] = way * half[i], way *= p.pass[i];
  p.all = way;
  way = 1;
  for (size_t i = kCells; i-- > 0;) p.last[i] = way * half[i], way *= p.pass[i];
  return p;
}

/// Flights of one cosine, both ways, mirrored at the sides any number of times.
void Slab::addFlights(const Direction& direction) {
  const Passing p = passing(direction.cosine);
  const double R = direction.reflectance, w = 0.5 * direction.weight;
  const double series = 1 / (1 - R * R * p.all * p.all);
  for (size_t i = 0; i < kCells; ++i) {
    const double atFirst = (p.first[i] + R * p.all * p.last[i]) * series,
                 atLast = (p.last[i] + R * p.all * p.first[i]) * series;
    leaving_[i] += w * (1 - R) * atFirst;
    Column& to = flights_[i];
    for (size_t j = 0; j < kCells; ++j)
      to[j] += w * R * width_[j] / direction.cosine * (atFirst * p.first[j] + atLast * p.last[j]);
    const double out = -std::expm1(-width_[i] / direction.cosine) * direction.cosine / width_[i];
    to[i] += 2 * w * (1 - out);
    double way = w * out;
    for (size_t j = i + 1; j < kCells; ++j) to[j] += way * (1 - p.pass[j]), way *= p.pass[j];
    way = w * out;
    for (size_t j = i; j-- > 0;) to[j] += way * (1 - p.pass[j]), way *= p.pass[j];
  }
}

/// (1 - albedo flights) leaving = what leaves without a collision, by elimination: diagonally dominant.
void Slab::solve(double albedo) {
  for (size_t i = 0; i < kCells; ++i)
    for (size_t j = 0; j < kCells; ++j) flights_[i][j] = (i == j ? 1 : 0) - albedo * flights_[i][j];
  for (size_t i = 0; i < kCells; ++i)
    for (size_t r = i + 1; r < kCells; ++r) {
      const double f = flights_[r][i] / flights_[i][i];
      for (size_t j = i + 1; j < kCells; ++j) flights_[r][j] -= f * flights_[i][j];
      leaving_[r] -= f * leaving_[i];
    }
  for (size_t i = kCells; i-- > 0;) {
    for (size_t j = i + 1; j < kCells; ++j) leaving_[i] -= flights_[i][j] * leaving_[j];
    leaving_[i] /= flights_[i][i];
  }
}

double Slab::reflected(double cosine) const {
  double way = 1, sum = 0;
  for (size_t i = 0; i < kCells; ++i) {
    const double pass = std::exp(-width_[i] / cosine);
    sum += way * (1 - pass) * leaving_[i];
    way *= pass;
  }
  return sum;
}

double Slab::leaving(double depth) const {
  const auto above = size_t(std::upper_bound(middle_.begin(), middle_.end(), depth) - middle_.begin());
  const size_t i = std::clamp(above, size_t(1), size_t(kCells - 1));
  const double x = (depth - middle_[i - 1]) / (middle_[i] - middle_[i - 1]);
  return leaving_[i - 1] + x * (leaving_[i] - leaving_[i - 1]);
}

/// Share of a source at depth z of a slab that diffusion lets out of its first side.
double diffusionLeaving(const Diffusion& d, double z, double thickness) {
  const double e = std::exp(-2 * d.k * thickness);
  const double slope = (1 + e) + d.zb * d.k * (1 - e);
  const double u0 = (1 - e) / d.k + d.zb * (1 + e);
  const double rest = std::exp(-2 * d.k * (thickness - z));
  return std::exp(-d.k * z) * ((1 - rest) / d.k + d.zb * (1 + rest)) / (u0 + d.zb * slope);
}

double depthOf(int i) {
  const double x = double(kDeepest) * i / (SlabTransport::kDepths - 1);
  return x / (1 - x);
}

double thicknessOf(int i) {
  return kThinnest * std::pow(kThickest / kThinnest, double(i) / (SlabTransport::kThicknesses - 1));
}

}  // namespace

SlabTransport::SlabTransport(const Diffusion& medium, double eta) {
  if (!(medium.albedo_p < 1)) return;
  table_.resize(kThicknesses);
  Diffusion unit = medium;  // in mean free paths
  unit.zb *= medium.sigma_tp;
  // By the albedo: the medium's own has a floor, which nearly clear media meet.
  unit.k = std::max(1e-3, std::sqrt(3 * (1 - medium.albedo_p) / (2 - medium.albedo_p)));
  const Slab deep(kThickest, medium.albedo_p, directionsOf(eta));
  for (int d = 0; d < kDepths; ++d) {
    const double z = depthOf(d), diffused = diffusionLeaving(unit, z, kThickest);
    const double absorbed = 1 - diffused;
    const double more = absorbed > 1e-9 ? (1 - deep.leaving(z)) / absorbed - 1 : 0;
    for (int t = 0; t < kThicknesses; ++t) {
      const double thickness = thicknessOf(t), depth = std::min(z, 0.5 * thickness);
      const double left =
          diffusionLeaving(unit, depth, thickness) + diffusionLeaving(unit, thickness - depth, thickness);
      table_[size_t(t)][size_t(d)] = float(-more * std::max(0.0, 1 - left) / std::max(1e-12, left));
    }
  }
}

float SlabTransport::excess(float thickness, float depth) const {
  if (table_.empty()) return 0;
  const float last = kThicknesses - 1;
  const float t = std::clamp(std::log(std::fmax(thickness, 1e-6f) / float(kThinnest)) /
                                 float(std::log(kThickest / kThinnest)) * last,
                             0.0f, last);
  const float d = std::fmin(depth / (1 + depth) / kDeepest, 1.0f) * (kDepths - 1);
  const int i = std::min(int(t), kThicknesses - 2), j = std::min(int(d), kDepths - 2);
  const float x = t - float(i), y = d - float(j);
  const auto &a = table_[size_t(i)], &b = table_[size_t(i) + 1];
  const auto k = size_t(j);
  const float thin = std::fmin(1.0f, thickness / float(kThinnest));
  return thin * ((1 - x) * ((1 - y) * a[k] + y * a[k + 1]) + x * ((1 - y) * b[k] + y * b[k + 1]));
}

double SlabTransport::reflectance(double albedo, double eta, double cosine) {
  return albedo * Slab(kThickest, albedo, directionsOf(eta)).reflected(cosine);
}

}  // namespace lychnite::volume
