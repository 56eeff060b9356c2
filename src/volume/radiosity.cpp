#include "volume/radiosity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <unordered_map>

namespace lychnite::volume {

namespace {

// Standard deviations of the smoothing, voxels. The least falls with the sixth root of the photons' density,
// from kWidest to kLeastWidth.
constexpr size_t kWidths = 4;
constexpr double kLeastWidth = 0.5, kWidest = 6, kWidthOfOne = 1.9;
constexpr double kPhotonsOfOne = 8;  // per voxel's face, where it is kWidthOfOne
constexpr double kBeamWidth = 1.1;   // of what has no noise: hides the cells
constexpr double kAgainWidth = 2.5;
constexpr double kBeams = 4;        // looks of the first order per voxel's face, about
constexpr float kBlock = 4;         // voxels: errors are averaged over 3 x 3 x 3 blocks of this side
constexpr double kChoiceWidth = 2;  // voxels, by which the choice of widths is blended
constexpr double kVarianceWidth = 2;

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

Residuals residualsOf(const Smoother& smoother, const NodeEstimate& estimate, const Field& base) {
  const double least = leastWidth(estimate.photons);
  std::vector<Smoother::Filter> widths;
  for (size_t w = 0; w < kWidths; ++w)
    widths.push_back(smoother.filter(twice(least * std::pow(kWidest / least, double(w) / (kWidths - 1)))));
  Residuals result;
  for (size_t half : {0, 1}) {
    result.raw[half] = estimate.half[half];
    for (size_t i = 0; i < base.size(); ++i) result.raw[half][i] -= base[i];
  }
  auto out = smoother.filtered({{result.raw[0], widths}, {result.raw[1], widths}});
  for (size_t half : {0, 1}) result.smooth[half] = std::move(out[half]);
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

struct Base {
  Field once, again;  ///< light that enters for the first time; light that left before
};

/// What is known without noise: a half-space's response below the cells, the beams above them.
Base baseOf(const Smoother& smoother, const NodeEstimate& estimate, const Smoother::Response& response,
            double width) {
  const auto coarse = twice(width);
  const auto fine = [&](double q, int c) { return (1 - coarse(q, c)) * response(q, c); };
  const auto out = smoother.filtered({{estimate.beam, {smoother.filter(coarse)}},
                                      {estimate.entering, {smoother.filter(fine)}},
                                      {estimate.again, {smoother.filter(gaussian(kAgainWidth))}}});
  Base base{out[0][0], out[2][0]};
  for (size_t i = 0; i < base.once.size(); ++i) base.once[i] += out[1][0][i];
  return base;
}

}  // namespace

NodeFlux cleaned(const Smoother& smoother, const Surface& surface, const NodeEstimate& estimate,
                 const Smoother::Response& response) {
  const Base base = baseOf(smoother, estimate, response, kBeamWidth);
  NodeFlux result{base.once, {}};
  for (size_t i = 0; i < base.again.size(); ++i) result.flux[i] += base.again[i];
  if (estimate.half[0].empty()) return result;
  const Residuals residuals = residualsOf(smoother, estimate, base.once);
  const Field share =
      choose(smoother, surface, sumsAround(surface.grid(), surface, squareErrors(surface, residuals)));
  const auto& nodes = surface.nodes();
  Field squares(nodes.size(), kZero);  // of the mean's deviation, units that add up over area
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (!(nodes[i].area > 0)) continue;
    Lanes deviation = kZero;
    for (size_t w = 0; w < kWidths; ++w) {
      const Lanes &a = residuals.smooth[0][w][i], &b = residuals.smooth[1][w][i];
      result.flux[i] += share[i][int(w)] * 0.5f * (a + b);
      deviation += share[i][int(w)] * 0.5f * (a - b);
    }
    squares[i] = deviation * deviation / nodes[i].area;
  }
  auto smooth = smoother.filtered({{std::move(squares), {smoother.filter(gaussian(kVarianceWidth))}}});
  result.variance = std::move(smooth[0][0]);
  for (size_t i = 0; i < nodes.size(); ++i)
    for (int c = 0; c < 3; ++c) result.variance[i][c] = std::max(0.0f, result.variance[i][c] * nodes[i].area);
  return result;
}

std::vector<Lanes> cleanedFirst(const Smoother& smoother, const NodeEstimate& estimate,
                                const Smoother::Response& response) {
  NodeEstimate known = estimate;
  if (!known.half[0].empty())
    for (size_t i = 0; i < known.beam.size(); ++i)
      known.beam[i] = 0.5f * (known.half[0][i] + known.half[1][i]);
  return baseOf(smoother, known, response, leastWidth(std::max(kBeams, estimate.photons))).once;
}

}  // namespace lychnite::volume
