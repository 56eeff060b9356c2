#include "volume/radiosity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <unordered_map>

#include "volume/gather.h"

namespace lychnite::volume {

namespace {

// Standard deviations of the smoothing, voxels. The least falls with the sixth root of the photons' density,
// from kWidest to kLeastWidth.
constexpr size_t kWidths = 4;
constexpr double kLeastWidth = 0.5, kWidest = 6, kWidthOfOne = 1;
constexpr double kPhotonsOfOne = 8;  // per voxel's face, where it is kWidthOfOne
constexpr double kBeamWidth = 0.8;   // of what has no noise: hides the cells
constexpr double kAgainWidth = 2.5;
constexpr double kLooks = 4;        // for the first order, without photons, per voxel's face, about
constexpr float kBlock = 4;         // voxels: errors are averaged over 3 x 3 x 3 blocks of this side
constexpr double kChoiceWidth = 2;  // voxels, by which the choice of widths is blended
constexpr double kVarianceWidth = 2;
constexpr float kLeastFine = 0.005f;  // of what enters, finer than nodes, worth looking for

using Field = std::vector<Lanes>;

constexpr Lanes kZero{0, 0, 0, 0};

double leastWidth(double photons) {
  return std::clamp(kWidthOfOne * std::pow(photons / kPhotonsOfOne, -1.0 / 6), kLeastWidth, kWidest);
}

Smoother::Response gaussian(double width) {
  return [width](double q, int) { return std::exp(-0.5 * width * width * q * q); };
}

/// A Gaussian, and once more of what it leaves out (twicing: Stuetzle & Mittal 1979): unlike the Gaussian
/// alone it keeps curvature.
Smoother::Response twice(double width) {
  return [width](double q, int) {
    const double g = std::exp(-0.5 * width * width * q * q);
    return g * (2 - g);
  };
}

/// What each half differs from what is known without noise, as it is and smoothed by each width.
struct Residuals {
  Field raw[2];
  std::vector<Field> smooth[2];
};

Residuals residualsOf(const Smoother& smoother, const Field half[2], double photons, const Field& base) {
  const double least = leastWidth(photons);
  std::vector<Smoother::Filter> widths;
  for (size_t w = 0; w < kWidths; ++w)
    widths.push_back(smoother.filter(twice(least * std::pow(kWidest / least, double(w) / (kWidths - 1)))));
  Residuals result;
  for (size_t h : {0, 1}) {
    result.raw[h] = half[h];
    for (size_t i = 0; i < base.size(); ++i) result.raw[h][i] -= base[i];
  }
  auto out = smoother.filtered({{result.raw[0], widths}, {result.raw[1], widths}});
  for (size_t h : {0, 1}) result.smooth[h] = std::move(out[h]);
  return result;
}

/// Expected square error of the mean of both halves for each width, up to what is the same for all, in units
/// that add up over area: a smoothed half against the other as it is holds the bias and all of a half's
/// noise, of which the mean has half.
Field squareErrors(const Surface& surface, const Residuals& residuals) {
  const auto& nodes = surface.nodes();
  Field error(nodes.size(), kZero);
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (!(nodes[i].area > 0)) continue;
    for (size_t w = 0; w < kWidths; ++w) {
      const Lanes &a = residuals.smooth[0][w][i], &b = residuals.smooth[1][w][i];
      const Lanes ab = a - residuals.raw[1][i], ba = b - residuals.raw[0][i];
      const Lanes s = 0.5f * (ab * ab + ba * ba) - 0.25f * (a - b) * (a - b);
      error[i][int(w)] = (s[0] + s[1] + s[2]) / nodes[i].area;
    }
  }
  return error;
}

/// Sums over all nodes nearby that face the same main way.
Field sumsAround(const Grid& grid, const Surface& surface, const Field& values) {
  const auto& nodes = surface.nodes();
  const auto keyOf = [](const glm::ivec3& block, int way) {
    return (((uint64_t(block.z) << 20 | uint64_t(block.y)) << 20 | uint64_t(block.x)) << 3) | uint64_t(way);
  };
  const auto placeOf = [&](size_t i) {
    const glm::vec3 a = glm::abs(nodes[i].normal);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    const glm::ivec3 block(glm::floor(grid.voxels(nodes[i].position) / kBlock + 2.0f));
    return std::pair(block, 2 * axis + (nodes[i].normal[axis] > 0 ? 1 : 0));
  };
  std::unordered_map<uint64_t, Lanes> blocks, wide;
  for (size_t i = 0; i < nodes.size(); ++i) {
    const auto [block, way] = placeOf(i);
    blocks.try_emplace(keyOf(block, way), kZero).first->second += values[i];
  }
  Field sums(nodes.size());
  for (size_t i = 0; i < nodes.size(); ++i) {
    const auto [block, way] = placeOf(i);
    const auto [entry, isNew] = wide.try_emplace(keyOf(block, way), kZero);
    for (int n = 0; isNew && n < 27; ++n) {
      const auto near = blocks.find(keyOf(block + glm::ivec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1), way));
      if (near != blocks.end()) entry->second += near->second;
    }
    sums[i] = entry->second;
  }
  return sums;
}

/// Each node's shares of the widths.
Field choose(const Smoother& smoother, const Surface& surface, const Field& errors) {
  const auto& nodes = surface.nodes();
  Field choice(nodes.size(), kZero);
  for (size_t i = 0; i < nodes.size(); ++i) {
    int best = 0;
    for (int w = 1; w < int(kWidths); ++w)
      if (errors[i][w] < errors[i][best]) best = w;
    choice[i][best] = nodes[i].area;
  }
  auto blended = smoother.filtered({{std::move(choice), {smoother.filter(gaussian(kChoiceWidth))}}});
  for (size_t i = 0; i < nodes.size(); ++i)
    blended[0][0][i] = nodes[i].area > 0 ? blended[0][0][i] / nodes[i].area : kZero;
  return std::move(blended[0][0]);
}

/// Light that is told without noise by `measured` down to the width, below it by a half-space's response to
/// what enters.
struct Known {
  const Field& measured;
  const Smoother::Response& response;
  double width;
};

/// It, and what `again` is smoothed by its width where that is given.
Field blended(const Smoother& smoother, const Field& entering, const Known& known, const Field* again) {
  const auto coarse = twice(known.width);
  const auto below = [&](double q, int c) { return (1 - coarse(q, c)) * known.response(q, c); };
  std::vector<Smoother::Task> tasks{{known.measured, {smoother.filter(coarse)}},
                                    {entering, {smoother.filter(below)}}};
  if (again) tasks.push_back({*again, {smoother.filter(gaussian(kAgainWidth))}});
  auto out = smoother.filtered(tasks);
  for (size_t i = 0; i < entering.size(); ++i)
    for (size_t t = 1; t < out.size(); ++t) out[0][0][i] += out[t][0][i];
  return std::move(out[0][0]);
}

/// What the photons' halves correct `base` by, and half of what the halves differ by then.
struct Corrected {
  Field flux, deviation;
};

Corrected corrected(const Smoother& smoother, const Surface& surface, Field base, const Field half[2],
                    double photons) {
  const Residuals residuals = residualsOf(smoother, half, photons, base);
  const Field share =
      choose(smoother, surface, sumsAround(surface.grid(), surface, squareErrors(surface, residuals)));
  Corrected result{std::move(base), Field(share.size(), kZero)};
  for (size_t i = 0; i < share.size(); ++i) {
    if (!(surface.nodes()[i].area > 0)) continue;
    for (size_t w = 0; w < kWidths; ++w) {
      const Lanes &a = residuals.smooth[0][w][i], &b = residuals.smooth[1][w][i];
      result.flux[i] += share[i][int(w)] * 0.5f * (a + b);
      result.deviation[i] += share[i][int(w)] * 0.5f * (a - b);
    }
  }
  return result;
}

Field varianceOf(const Smoother& smoother, const Surface& surface, const Field& deviation) {
  const auto& nodes = surface.nodes();
  Field squares(nodes.size(), kZero);  // in units that add up over area
  for (size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].area > 0) squares[i] = deviation[i] * deviation[i] / nodes[i].area;
  auto smooth = smoother.filtered({{std::move(squares), {smoother.filter(gaussian(kVarianceWidth))}}});
  Field variance = std::move(smooth[0][0]);
  for (size_t i = 0; i < nodes.size(); ++i)
    for (int c = 0; c < 3; ++c) variance[i][c] = std::max(0.0f, variance[i][c] * nodes[i].area);
  return variance;
}

Corrected firstOrderOf(const Smoother& smoother, const Surface& surface, const NodeEstimate& estimate,
                       const FirstOrder& first) {
  Field base =
      blended(smoother, estimate.entering, {first.flux, first.response, leastWidth(kLooks)}, nullptr);
  if (first.half[0].empty()) return {std::move(base), {}};
  return corrected(smoother, surface, std::move(base), first.half, estimate.photons);
}

}  // namespace

NodeFlux cleaned(const Smoother& smoother, const Surface& surface, const NodeEstimate& estimate,
                 const Smoother::Response& response, const FirstOrder* first) {
  Field base = blended(smoother, estimate.entering, {estimate.beam, response, kBeamWidth}, &estimate.again);
  const bool photons = !estimate.half[0].empty();
  Corrected all = photons ? corrected(smoother, surface, std::move(base), estimate.half, estimate.photons)
                          : Corrected{std::move(base), {}};
  if (first) {
    const Corrected once = firstOrderOf(smoother, surface, estimate, *first);
    for (size_t i = 0; i < all.flux.size(); ++i) all.flux[i] -= once.flux[i];
    for (size_t i = 0; i < all.deviation.size(); ++i) all.deviation[i] -= once.deviation[i];
  }
  if (!photons) return {std::move(all.flux), {}};
  return {std::move(all.flux), varianceOf(smoother, surface, all.deviation)};
}

std::vector<Lanes> cleanedFirst(const Smoother& smoother, const Surface& surface,
                                const NodeEstimate& estimate, const FirstOrder& first) {
  return firstOrderOf(smoother, surface, estimate, first).flux;
}

glm::vec3 fineShare(const Smoother::Response& response, double finest) {
  constexpr double kFirst = 0.05, kLast = 50, kStep = 1.1;  // radians per voxel
  constexpr double kVariance =
      double(Gather::kWidth) * double(Gather::kWidth) + 1.0 / 48;  // nodes are half voxels
  glm::dvec3 sum(0);
  double all = 0;
  for (double q = kFirst; q < kLast; q *= kStep) {
    const double lost = -std::expm1(-0.5 * kVariance * q * q);
    const double weight = lost * lost / q;  // q^-3 q dq, and dq goes with q
    for (int c = 0; c < 3; ++c) sum[c] += weight * response(q, c);
    all += weight;
  }
  glm::vec3 share(sum / all);
  for (int c = 0; c < 3; ++c)
    share[c] = std::clamp(float(response(finest, c)), 0.0f, std::max(0.0f, share[c]));
  return std::max({share.x, share.y, share.z}) < kLeastFine ? glm::vec3(0) : share;
}

}  // namespace lychnite::volume
