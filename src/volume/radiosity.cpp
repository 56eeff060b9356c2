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

/// Light that is told without noise by `measured` down to the width, below it by a half-space's response to
/// what enters.
struct Known {
  const Field& measured;
  const Smoother::Response& response;
  double width;
};

/// Each of them, then what `tasks`, of one filter each, make: all in one go. 1 to 3 of both together.
std::vector<Field> blended(const Smoother& smoother, const Field& entering, const std::vector<Known>& known,
                           std::vector<Smoother::Task> tasks) {
  std::vector<Smoother::Filter> below;
  for (size_t k = 0; k < known.size(); ++k) {
    const auto coarse = twice(known[k].width);
    below.push_back(
        smoother.filter([&](double q, int c) { return (1 - coarse(q, c)) * known[k].response(q, c); }));
    tasks.insert(tasks.begin() + long(k), {known[k].measured, {smoother.filter(coarse)}});
  }
  tasks.push_back({entering, std::move(below)});
  auto out = smoother.filtered(tasks);
  std::vector<Field> result;
  for (size_t t = 0; t + 1 < tasks.size(); ++t) result.push_back(std::move(out[t][0]));
  for (size_t k = 0; k < known.size(); ++k)
    for (size_t i = 0; i < entering.size(); ++i) result[k][i] += out.back()[k][i];
  return result;
}

}  // namespace

NodeFlux cleaned(const Smoother& smoother, const Surface& surface, const NodeEstimate& estimate,
                 const Smoother::Response& response, const FirstOrder* first) {
  std::vector<Known> known{{estimate.beam, response, kBeamWidth}};
  if (first) known.push_back({first->flux, first->response, leastWidth(std::max(kLooks, estimate.photons))});
  const auto base = blended(smoother, estimate.entering, known,
                            {{estimate.again, {smoother.filter(gaussian(kAgainWidth))}}});
  NodeFlux result{base[0], {}};
  for (size_t i = 0; i < result.flux.size(); ++i) {
    result.flux[i] += base.back()[i];
    if (first) result.flux[i] -= base[1][i];
  }
  if (estimate.half[0].empty()) return result;
  Field known0 = base[0];
  for (size_t i = 0; i < known0.size(); ++i) known0[i] += base.back()[i];
  const Residuals residuals = residualsOf(smoother, estimate, known0);
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
                                const FirstOrder& first) {
  const double width = leastWidth(std::max(kLooks, estimate.photons));
  return blended(smoother, estimate.entering, {{first.flux, first.response, width}}, {})[0];
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
