#include "lychnite/optics/tabulated_profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "lychnite/optics/fresnel.h"
#include "optics/smooth_curve.h"

namespace lychnite {
namespace {

constexpr double kRoughness =
    3e5;  // 1 / (third difference of the logarithm that is still taken for the curve's)^2
constexpr double kMostDeviation = 0.25;  // relative, of a ring that counts
constexpr int kStepsPerRing = 16;        // of the sums that make P

/// Decay of a medium's diffuse light per reduced mean free path: nu with albedo = 2 nu / ln((1 + nu)/(1 -
/// nu)), the discrete eigenvalue of isotropic transport (Case & Zweifel 1967). sigma_tr is its limit at
/// albedo 1.
double decayOf(double albedo_p) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double nu = 0.5 * (low + high);
    (2 * nu / std::log((1 + nu) / (1 - nu)) > albedo_p ? low : high) = nu;
  }
  return 0.5 * (low + high);
}

/// The curve that a measured one is divided by so that their ratio is smooth and level far out: [J01]'s
/// dipole with the true decay. Mean free paths.
struct Shape {
  double zr, zv, decay;

  Shape(double albedo, double g, double eta) {
    const double sigma_tp = 1 - albedo * g, Fdr = diffuseFresnelReflectance(eta);
    zr = 1 / sigma_tp;
    zv = zr * (1 + 4.0 / 3 * (1 + Fdr) / (1 - Fdr));
    decay = sigma_tp * decayOf(albedo * (1 - g) / sigma_tp);
  }
  double Rd(double r) const { return flux(r, zr) + flux(r, zv); }
  double P(double r) const { return 2 * std::numbers::pi * (tail(r, zr) + tail(r, zv)); }

 private:
  double flux(double r, double z) const {
    const double d = std::hypot(r, z);
    return z * (1 + decay * d) * std::exp(-decay * d) / (d * d * d);
  }
  double tail(double r, double z) const {
    const double d = std::hypot(r, z);
    return z * std::exp(-decay * d) / d;
  }
};

/// One channel; lengths in mean free paths.
class Curve {
 public:
  Curve(const MeasuredProfile& measured, const MeasuredProfile::Part& part, int channel, const Shape& shape)
      : shape_(shape), first_(measured.ringEdges[1]), perRing_(std::log(measured.ringEdges[2] / first_)) {
    smoothRatio(measured.ringEdges, part, channel);
    sumUp(part.total[channel]);
  }

  double Rd(double r) const { return r < first_ ? core_ : scale_ * rawRd(r).value; }
  double P(double r) const {
    if (r < first_) return total_ - core_ * std::numbers::pi * r * r;
    const double x = std::log(r / first_) / perRing_ * kStepsPerRing;
    if (x >= double(beyond_.size() - 1)) return scale_ * std::exp(ratio_.back()) * shape_.P(r);
    // Cubic between the sums, whose slope is Rd.
    const auto i = size_t(x);
    const double t = x - double(i), p1 = beyond_[i], p2 = beyond_[i + 1], m1 = slope_[i], m2 = slope_[i + 1];
    return (((2 * (p1 - p2) + m1 + m2) * t + 3 * (p2 - p1) - 2 * m1 - m2) * t + m1) * t + p1;
  }

 private:
  void smoothRatio(const std::vector<double>& edges, const MeasuredProfile::Part& part, int channel) {
    std::vector<double> values, weights;
    for (size_t i = 1; i + 1 < edges.size(); ++i) {
      const double area = std::numbers::pi * (edges[i + 1] * edges[i + 1] - edges[i] * edges[i]);
      const double shape = (shape_.P(edges[i]) - shape_.P(edges[i + 1])) / area;
      const double value = part.exitance[i][channel], deviation = part.deviation[i][channel];
      const bool counts = value > 0 && shape > 1e-250 && deviation < kMostDeviation * value;
      values.push_back(counts ? std::log(value / shape) : 0);
      weights.push_back(counts ? std::pow(value / std::max(deviation, 1e-4 * value), 2) : 0);
    }
    ratio_ = whittakerSmoothed(values, weights, kRoughness);
  }

  /// Rd before scaling, and the slope of its logarithm over that of r.
  CurvePoint rawRd(double r) const {
    const CurvePoint ratio = curveAt(ratio_, std::log(r / first_) / perRing_ - 0.5);
    const double shape = shape_.Rd(r), dr = 1e-4 * r;
    return {shape * std::exp(ratio.value),
            ratio.derivative / perRing_ + (shape_.Rd(r + dr) / shape - 1) / 1e-4};
  }

  void sumUp(double total) {
    const size_t steps = ratio_.size() * kStepsPerRing;
    const double step = perRing_ / kStepsPerRing;
    const auto perStep = [&](double i) {  // Rd 2 pi r dr
      const double r = first_ * std::exp(i * step);
      return 2 * std::numbers::pi * r * r * step * rawRd(r).value;
    };
    beyond_.assign(steps + 1, std::exp(ratio_.back()) * shape_.P(first_ * std::exp(double(steps) * step)));
    slope_.resize(steps + 1);
    for (size_t i = steps; i-- > 0;)  // Simpson
      beyond_[i] =
          beyond_[i + 1] + (perStep(double(i)) + 4 * perStep(double(i) + 0.5) + perStep(double(i) + 1)) / 6;
    for (size_t i = 0; i <= steps; ++i) slope_[i] = -perStep(double(i));
    // Within the first ring Rd is its mean, going on as the power of r that it has there.
    const CurvePoint edge = rawRd(first_);
    const double core = edge.value * 2 / (2 - std::clamp(-edge.derivative, 0.0, 1.2));
    scale_ = total / (beyond_.front() + core * std::numbers::pi * first_ * first_);
    core_ = scale_ * core;
    total_ = total;
    for (double& p : beyond_) p *= scale_;
    for (double& m : slope_) m *= scale_;
  }

  Shape shape_;
  double first_, perRing_;
  std::vector<double> ratio_;           ///< logarithm of measured over shape, at the rings' middles
  std::vector<double> beyond_, slope_;  ///< P and its slope by the step
  double scale_ = 1, core_ = 0, total_ = 0;
};

class TabulatedProfile final : public Profile {
 public:
  TabulatedProfile(const MeasuredProfile& measured, ProfileOrders orders, const Coefficients& m)
      : sigma_t_(m.sigma_t()) {
    const MeasuredProfile::Part& part = orders == ProfileOrders::kAll ? measured.all : measured.fromSecond;
    assert(measured.ringEdges.size() >= 6 && part.exitance.size() + 1 == measured.ringEdges.size());
    for (int c = 0; c < 3; ++c) {
      if (!(m.sigma_s[c] > 0) || !(part.total[c] > 0)) continue;
      const Shape shape(m.albedo()[c], m.g, m.eta);
      curves_[c] = std::make_unique<Curve>(measured, part, c, shape);
      core_[c] = 1 / m.sigma_tp()[c];
      decay_[c] = shape.decay * sigma_t_[c];
    }
  }

  Rgb Rd(double r) const override {
    Rgb result(0);
    for (int c = 0; c < 3; ++c)
      if (curves_[c]) result[c] = curves_[c]->Rd(r * sigma_t_[c]) * sigma_t_[c] * sigma_t_[c];
    return result;
  }
  Rgb P(double r) const override {
    Rgb result(0);
    for (int c = 0; c < 3; ++c)
      if (curves_[c]) result[c] = curves_[c]->P(r * sigma_t_[c]);
    return result;
  }
  Rgb coreLength() const override { return core_; }
  Rgb tailDecay() const override { return decay_; }

 private:
  Rgb sigma_t_, core_{0}, decay_{0};
  std::unique_ptr<Curve> curves_[3];
};

}  // namespace

std::unique_ptr<Profile> makeTabulated(const MeasuredProfile& measured, ProfileOrders orders,
                                       const Coefficients& medium) {
  return std::make_unique<TabulatedProfile>(measured, orders, medium);
}

}  // namespace lychnite
