#include "lychnite/reference/surface_walk.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "lychnite/base/error.h"
#include "reference/surface_samples.h"
#include "reference/walk_photon.h"

namespace lychnite {

namespace {

using transport::Rng;

constexpr uint64_t kBlock = 1024;  // photons of one stratified set and one random stream
constexpr uint64_t kTurnStream = uint64_t(1) << 61;
constexpr uint64_t kWave = 24;  // blocks between two looks at the clock; of both halves and all channels

class SurfaceWalk {
 public:
  SurfaceWalk(const Scene& scene, const SurfaceWalkSettings& settings, const LogSink& log)
      : settings_(settings), rays_(scene), emission_(rays_), world_(makeWalkWorld(rays_, emission_, log)) {
    for (size_t i = 0; i < rays_.objectCount(); ++i) {
      samplers_.push_back(rays_.opaque(int(i)) ? nullptr
                                               : std::make_unique<SurfaceSampler>(rays_.mesh(int(i))));
      for (auto& half : flux_) half.emplace_back(samplers_.back() ? settings.patches : 0, Rgb(0));
    }
  }

  SurfaceWalkResult run(const Progress& progress) {
    for (double fraction = 0; !emission_.empty() && fraction < 1; fraction = made()) {
      progress.check({"surface walk", fraction, fmt::format("{:.3g} photons", double(blocks_ * kBlock))});
      traceWave();
    }
    return result();
  }

 private:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  /// Of what is to be done.
  double made() const {
    if (settings_.timeLimit <= 0 && settings_.noise <= 0) return double(blocks_ * kBlock) / settings_.photons;
    double made = settings_.timeLimit > 0 ? seconds() / settings_.timeLimit : 0;
    if (settings_.noise <= 0) return made;
    const double now = noise();
    return std::max(made, now > 0 ? std::pow(settings_.noise / now, 2) : 1);
  }
  /// Of a half. By radiosity, which objects of different area have in common.
  double noise() const {
    double squares = 0, sum = 0, count = 0;
    for (size_t i = 0; i < samplers_.size(); ++i) {
      if (!samplers_[i]) continue;
      const double perArea = 1 / samplers_[i]->area();
      for (size_t p = 0; p < settings_.patches; ++p) {
        const Rgb a = perArea * flux_[0][i][p], b = perArea * flux_[1][i][p], d = a - b;
        squares += 0.5 * (d.x * d.x + d.y * d.y + d.z * d.z);
        sum += 0.5 * (a.x + a.y + a.z + b.x + b.y + b.z);
        count += 3;
      }
    }
    return sum > 0 ? std::sqrt(squares * count) / sum : 0;
  }
  /// Every other three blocks, of the three channels in turn, make a half.
  static size_t halfOf(uint64_t block) { return size_t(block / 3 % 2); }

  void traceWave() {
    std::vector<std::vector<WalkExit>> exits(kWave);
    tbb::parallel_for(uint64_t(0), kWave, [&](uint64_t b) {
      const uint64_t block = blocks_ + b;
      WalkPhotons photons(world_, guide_, nullptr, nullptr, Rng(settings_.seed, 2 * block));
      photons.keepExits(&exits[b]);
      Rng jitter(settings_.seed, 2 * block + 1);
      const uint64_t turn = Rng(settings_.seed, kTurnStream + block / 3).below(3) + block;
      for (uint64_t i = 0; i < kBlock; ++i)
        photons.fly((double(i) + double(jitter.uniform())) / double(kBlock), int((i + turn) % 3));
    });
    for (uint64_t b = 0; b < kWave; ++b)
      for (const WalkExit& exit : exits[b]) {
        const auto object = size_t(exit.object);
        if (samplers_[object])
          flux_[halfOf(blocks_ + b)][object][samplers_[object]->patchOf(exit.point, settings_.patches)] +=
              Rgb(exit.flux);
      }
    blocks_ += kWave;
  }

  SurfaceWalkResult result() const {
    SurfaceWalkResult result;
    result.photons = double(blocks_ * kBlock);
    for (size_t half : {0, 1}) {
      result.radiosity[half] = flux_[half];
      for (size_t i = 0; i < samplers_.size(); ++i) {
        if (!samplers_[i]) continue;
        const double area = samplers_[i]->area() / double(settings_.patches);
        for (Rgb& r : result.radiosity[half][i]) r *= 2 / (std::max(result.photons, 1.0) * area);
      }
    }
    result.noise = noise();
    result.seconds = seconds();
    return result;
  }

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  SurfaceWalkSettings settings_;
  RayScene rays_;
  WalkEmission emission_;
  WalkWorld world_;
  WalkGuide guide_{0};
  std::vector<std::unique_ptr<SurfaceSampler>> samplers_;  ///< null for opaque objects
  std::vector<std::vector<Rgb>> flux_[2];
  uint64_t blocks_ = 0;
};

void validate(const SurfaceWalkSettings& settings) {
  const auto require = [](bool holds, const char* where, const char* expected, double found) {
    if (!holds)
      throw Error({.where = where, .expected = expected, .found = fmt::format("{}", found), .todo = {}},
                  Error::Kind::kUsage);
  };
  require(settings.patches >= 1 && settings.patches <= (1u << 24), "patches", "1 to 2^24",
          double(settings.patches));
  require(settings.photons >= 1, "photons", "at least 1", settings.photons);
  require(settings.timeLimit >= 0, "timeLimit", "0 or more seconds", settings.timeLimit);
  require(settings.noise >= 0, "noise", "0 or more", settings.noise);
}

}  // namespace

SurfaceWalkResult surfaceWalk(const Scene& scene, const SurfaceWalkSettings& settings,
                              const Progress& progress, const LogSink& log) {
  validate(scene);
  validate(settings);
  tbb::task_arena arena(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic);
  return arena.execute([&] { return SurfaceWalk(scene, settings, log).run(progress); });
}

std::vector<MeshPoint> patchPoints(const Scene& scene, int object, size_t patches, size_t each,
                                   uint64_t seed) {
  const RayScene rays(scene);
  return SurfaceSampler(rays.mesh(object)).pointsOfPatches(patches, each, seed);
}

}  // namespace lychnite
