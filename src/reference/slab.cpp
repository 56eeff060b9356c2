#include "lychnite/reference/slab.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "lychnite/base/error.h"
#include "reference/transport.h"

namespace lychnite {

namespace {

using transport::Medium;
using transport::PathWeight;
using transport::Rng;

constexpr uint64_t kBlock = 2048;        // photons that are summed before they count as one draw of the error
constexpr float kRouletteBelow = 0.05f;  // of the unit that a photon starts with
constexpr double kFirstDepthRoulette = 64;  // mean free paths; see goesDeeper

void validate(const SlabSettings& s) {
  const auto fail = [](const char* where, const char* expected, double found) {
    throw Error({.where = where, .expected = expected, .found = fmt::format("{}", found), .todo = {}},
                Error::Kind::kUsage);
  };
  validate(s.medium, "slab");
  if (!(s.thickness > 0)) fail("--thickness", "a length above 0, or inf", s.thickness);
  if (!(s.incidenceDegrees >= 0 && s.incidenceDegrees < 90))
    fail("--incidence", "0 to below 90 degrees", s.incidenceDegrees);
  if (s.photons < 1) fail("--photons", "at least 1", double(s.photons));
  if (s.threads < 0) fail("--threads", "0 or more", s.threads);
  if (s.ringEdges.size() == 1 || s.ringEdges.size() > 1'000'001)
    fail("--radial", "1 to 1000000 rings", double(s.ringEdges.size()) - 1);
  for (size_t i = 0; i < s.ringEdges.size(); ++i)
    if (!(s.ringEdges[i] >= 0 && std::isfinite(s.ringEdges[i])) ||
        (i > 0 && !(s.ringEdges[i] > s.ringEdges[i - 1])))
      fail("--radial", "rings of a width above 0 mm", s.ringEdges[i]);
}

/// Shares of light that crosses the slab unscattered, all mirrorings between the two faces included.
struct Unscattered {
  Rgb specular{0};  ///< mirrored by the top, never inside
  Rgb returned{0};  ///< mirrored by the bottom, out of the top
  Rgb transmitted{0};
};

Unscattered unscatteredAt(const SlabSettings& s, double cosine) {
  const transport::Boundary entry = transport::fresnel(float(cosine), float(s.medium.eta));
  const double R = entry.reflectance;
  Unscattered result{Rgb(R), Rgb(0), Rgb(0)};
  if (std::isinf(s.thickness)) {
    const Rgb empty = Rgb(glm::equal(s.medium.sigma_t(), Rgb(0)));
    result.transmitted = (1 - R) * empty;
    return result;
  }
  const Rgb once = glm::exp(-s.medium.sigma_t() * s.thickness / double(entry.cosT));
  const Rgb round = 1.0 - R * R * once * once;
  result.transmitted = (1 - R) * (1 - R) * once / round;
  result.returned = (1 - R) * (1 - R) * R * once * once / round;
  return result;
}

Unscattered unscattered(const SlabSettings& s) {
  if (!s.diffuse) return unscatteredAt(s, std::cos(s.incidenceDegrees * std::numbers::pi / 180));
  constexpr int kSteps = 20000;
  Unscattered sum;
  for (int i = 0; i < kSteps; ++i) {  // uniform in cosine^2: the cosine-weighted mean
    const Unscattered part = unscatteredAt(s, std::sqrt((i + 0.5) / kSteps));
    sum.specular += part.specular / double(kSteps);
    sum.returned += part.returned / double(kSteps);
    sum.transmitted += part.transmitted / double(kSteps);
  }
  return sum;
}

/// Sums of one block of photons.
struct Tally {
  Rgb reflected{0}, reflectedOnce{0}, transmitted{0}, absorbed{0};
  std::vector<Rgb> reflectedRing, reflectedOnceRing, transmittedRing;
};

/// One photon on its way through the slab; lengths in mm, z downwards from the top.
class SlabPhoton {
 public:
  SlabPhoton(const SlabSettings& settings, const Medium& medium, Rng& rng, int channel)
      : settings_(settings), medium_(medium), rng_(rng) {
    const float cosine = settings.diffuse
                             ? std::sqrt(rng.uniform())
                             : std::cos(float(settings.incidenceDegrees) * transport::kPi / 180.0f);
    const transport::Boundary entry = transport::fresnel(cosine, medium.eta);
    weight_ = PathWeight(glm::vec3(1 - entry.reflectance), channel);
    direction_ = {std::sqrt(std::fmax(0.0f, 1 - entry.cosT * entry.cosT)), 0, entry.cosT};
    rouletteDepth_ =
        kFirstDepthRoulette / std::fmax(medium.sigma_t[channel] * (1 - std::abs(medium.g)), 1e-30f);
  }

  void trace(Tally& tally) {
    while (step(tally)) {
    }
  }

 private:
  /// One flight; false when the photon is gone.
  bool step(Tally& tally) {
    const float flight = weight_.drawFlight(medium_, rng_);
    const double ahead = toBoundary();
    if (!(flight < ahead)) return std::isfinite(ahead) && meetBoundary(ahead, tally);
    position_ += double(flight) * glm::dvec3(direction_);
    tally.absorbed += Rgb(weight_.scatter(medium_, flight));
    direction_ = transport::scattered(direction_, medium_.g, rng_);
    ++order_;
    return weight_.survives(kRouletteBelow, rng_) && goesDeeper();
  }

  double toBoundary() const {
    if (direction_.z < 0) return position_.z / -double(direction_.z);
    if (direction_.z > 0) return (settings_.thickness - position_.z) / double(direction_.z);
    return std::numeric_limits<double>::infinity();
  }

  bool meetBoundary(double distance, Tally& tally) {
    const bool top = direction_.z < 0;
    position_ += distance * glm::dvec3(direction_);
    position_.z = top ? 0 : settings_.thickness;
    weight_.pass(medium_, float(distance));
    const transport::Boundary boundary = transport::fresnel(std::abs(direction_.z), 1 / medium_.eta);
    if (rng_.uniform() < boundary.reflectance) {
      direction_.z = -direction_.z;
      return true;
    }
    if (order_ > 0) leave(top, tally);
    return false;
  }

  void leave(bool top, Tally& tally) const {
    const Rgb flux(weight_.flux());
    const bool once = top && order_ == 1;
    (top ? tally.reflected : tally.transmitted) += flux;
    if (once) tally.reflectedOnce += flux;
    const std::vector<double>& edges = settings_.ringEdges;
    const auto edge = std::upper_bound(edges.begin(), edges.end(), std::hypot(position_.x, position_.y));
    if (edge == edges.begin() || edge == edges.end()) return;
    const auto ring = size_t(edge - edges.begin() - 1);
    (top ? tally.reflectedRing : tally.transmittedRing)[ring] += flux;
    if (once) tally.reflectedOnceRing[ring] += flux;
  }

  /// In a half-space the walk of an unabsorbed photon has no mean length. Whenever one is twice as deep as
  /// before, half of them go on with twice the weight: unbiased, and the mean length is finite.
  bool goesDeeper() {
    if (std::isfinite(settings_.thickness) || position_.z < rouletteDepth_) return true;
    if (rng_.bits() & 1u) return false;
    weight_.scale(2);
    rouletteDepth_ *= 2;
    return true;
  }

  const SlabSettings& settings_;
  const Medium& medium_;
  Rng& rng_;
  PathWeight weight_;
  glm::dvec3 position_{0};
  glm::vec3 direction_{0, 0, 1};
  double rouletteDepth_ = 0;
  int order_ = 0;  ///< collisions so far
};

size_t ringCount(const SlabSettings& settings) {
  return settings.ringEdges.empty() ? 0 : settings.ringEdges.size() - 1;
}

Tally traceBlock(const SlabSettings& settings, const Medium& medium, uint64_t block, uint64_t photons) {
  Tally tally;
  for (auto* rings : {&tally.reflectedRing, &tally.reflectedOnceRing, &tally.transmittedRing})
    rings->resize(ringCount(settings));
  Rng rng(settings.seed, block);
  for (uint64_t i = 0; i < photons; ++i) SlabPhoton(settings, medium, rng, int(i % 3)).trace(tally);
  return tally;
}

/// Mean and standard error from blocks, weighted by their photons.
class BlockMean {
 public:
  void add(const Rgb& sum, double photons) {
    const Rgb mean = sum / photons;
    photons_ += photons;
    blocks_ += 1;
    sum_ += sum;
    squares_ += photons * mean * mean;
  }
  SlabShare share() const {
    const Rgb mean = sum_ / photons_;
    const Rgb variance = glm::max(squares_ / photons_ - mean * mean, Rgb(0));
    return {mean,
            blocks_ > 1 ? glm::sqrt(variance / (blocks_ - 1)) : Rgb(std::numeric_limits<double>::infinity())};
  }

 private:
  double photons_ = 0, blocks_ = 0;
  Rgb sum_{0}, squares_{0};
};

struct SlabMeans {
  BlockMean reflected, reflectedOnce, transmitted, absorbed;
  std::vector<BlockMean> reflectedRing, reflectedOnceRing, transmittedRing;

  explicit SlabMeans(size_t rings) : reflectedRing(rings), reflectedOnceRing(rings), transmittedRing(rings) {}
  void add(const Tally& tally, double photons) {
    reflected.add(tally.reflected, photons);
    reflectedOnce.add(tally.reflectedOnce, photons);
    transmitted.add(tally.transmitted, photons);
    absorbed.add(tally.absorbed, photons);
    for (size_t i = 0; i < reflectedRing.size(); ++i) {
      reflectedRing[i].add(tally.reflectedRing[i], photons);
      reflectedOnceRing[i].add(tally.reflectedOnceRing[i], photons);
      transmittedRing[i].add(tally.transmittedRing[i], photons);
    }
  }
};

std::vector<SlabShare> perArea(const std::vector<BlockMean>& rings, const std::vector<double>& edges) {
  std::vector<SlabShare> result;
  for (size_t i = 0; i < rings.size(); ++i) {
    const double area = std::numbers::pi * (edges[i + 1] * edges[i + 1] - edges[i] * edges[i]);
    const SlabShare share = rings[i].share();
    result.push_back({share.value / area, share.standardError / area});
  }
  return result;
}

SlabResult assemble(const SlabSettings& settings, const SlabMeans& means) {
  const Unscattered straight = unscattered(settings);
  SlabResult result;
  result.diffuse_reflectance = means.reflected.share();
  result.diffuse_reflectance.value += straight.returned;
  result.specular_reflectance.value = straight.specular;
  result.total_transmittance = means.transmitted.share();
  result.total_transmittance.value += straight.transmitted;
  result.unscattered_transmittance.value = straight.transmitted;
  result.absorbed = means.absorbed.share();
  result.reflectance_once = means.reflectedOnce.share();
  result.radialReflectance = perArea(means.reflectedRing, settings.ringEdges);
  result.radialReflectanceOnce = perArea(means.reflectedOnceRing, settings.ringEdges);
  result.radialTransmittance = perArea(means.transmittedRing, settings.ringEdges);
  return result;
}

}  // namespace

SlabResult simulateSlab(const SlabSettings& settings, const Progress& progress) {
  validate(settings);
  const auto start = std::chrono::steady_clock::now();
  const Medium medium(settings.medium);
  // At least 32 blocks, so that the standard error itself is known to about 13 %.
  const uint64_t block = std::clamp<uint64_t>(settings.photons / 32, 1, kBlock);
  const uint64_t blocks = (settings.photons + block - 1) / block;
  SlabMeans means(ringCount(settings));
  tbb::task_arena arena(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic);
  const uint64_t wave = uint64_t(arena.max_concurrency()) * 8;
  for (uint64_t first = 0; first < blocks; first += wave) {
    progress.check({"slab", double(first) / double(blocks),
                    fmt::format("{}/{} photons", first * block, settings.photons)});
    const uint64_t count = std::min(wave, blocks - first);
    std::vector<Tally> tallies(count);
    const auto photonsOf = [&](uint64_t b) { return std::min(block, settings.photons - b * block); };
    arena.execute([&] {
      tbb::parallel_for(uint64_t(0), count, [&](uint64_t i) {
        tallies[i] = traceBlock(settings, medium, first + i, photonsOf(first + i));
      });
    });
    for (uint64_t i = 0; i < count; ++i) means.add(tallies[i], double(photonsOf(first + i)));
  }
  SlabResult result = assemble(settings, means);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace lychnite
