#include "reference/walk.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <glm/common.hpp>

#include "lychnite/base/error.h"
#include "lychnite/scene/scene_file.h"
#include "reference/picture.h"
#include "reference/single_light.h"

namespace lychnite {

namespace {

using transport::Rng;

constexpr uint64_t kBlock = 1024;          // photons of one stratified set and one random stream
constexpr uint64_t kLargestBatch = 65536;  // photons between two looks at the picture
constexpr uint64_t kBatches = 32;          // at least, of a run of given length: variances good to 25 %
constexpr int kPilotBlocks = 16;
constexpr float kPilotChance = 0.3f;
constexpr uint64_t kPilotStream = uint64_t(1) << 62, kTurnStream = uint64_t(1) << 61;

class Walk {
 public:
  Walk(const RayScene& rays, const CameraReceivers& receivers, const RenderSettings& settings,
       const LogSink& log);

  void resume(const Image& image);
  /// Runs until a limit of the settings or the caller stops it; returns false for the latter.
  bool run(const Progress& progress);
  Image picture(bool finished, bool keepState) const;

 private:
  void learn();
  WalkTally traceBlocks(const WalkGuide& guide, WalkFilm* film, uint64_t first, uint64_t count,
                        std::vector<WalkGuideSamples>* learn) const;
  bool traceBatch(const Progress& progress);
  void passSingle();
  void flush(double photons, bool whole);
  double noise() const;
  double progressMade() const;
  bool enough() const { return progressMade() >= 1; }
  bool report(const Progress& progress) const;
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  double targetPhotons() const { return settings_.samples * double(pixels()); }
  size_t pixels() const { return size_t(settings_.width) * size_t(settings_.height); }
  bool openEnded() const { return settings_.timeLimit > 0 || settings_.noise > 0; }
  std::string fingerprint() const;
  void describe(Image& image) const;
  void saveState(Image& image) const;

  const RayScene& rays_;
  const CameraReceivers& receivers_;
  const RenderSettings& settings_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  WalkEmission emission_;
  WalkLens lens_;
  WalkWorld world_;
  SingleLight singleLight_;
  uint64_t batch_ = kBlock;
  std::unique_ptr<WalkFilm> film_;
  std::unique_ptr<WalkGuide> guide_;
  LayerMean multiple_, single_, radiosity_;
  WalkTally tally_;
  uint64_t blocks_ = 0;  ///< of photons, so far: the next random stream
};

Walk::Walk(const RayScene& rays, const CameraReceivers& receivers, const RenderSettings& settings,
           const LogSink& log)
    : rays_(rays),
      receivers_(receivers),
      settings_(settings),
      emission_(rays),
      lens_(rays, settings.width, settings.height),
      world_(makeWalkWorld(rays, emission_, log)),
      singleLight_(rays, receivers),
      multiple_(pixels()),
      single_(pixels()),
      radiosity_(settings.wants("radiosity") ? pixels() : 0) {
  world_.lens = &lens_;
  world_.radiosity = settings.wants("radiosity");
  const uint64_t even = openEnded() ? kLargestBatch : uint64_t(targetPhotons()) / kBatches;
  // A look at the picture costs as much as some photons: large pictures are looked at less often.
  const uint64_t largest = std::max<uint64_t>(kLargestBatch, pixels() / 8);
  batch_ = std::clamp<uint64_t>(even / kBlock, 1, largest / kBlock) * kBlock;
  const double all = std::max(emission_.power(), 1e-300) * lens_.largestImportance();
  film_ =
      std::make_unique<WalkFilm>(pixels(), world_.radiosity ? 2 : 1, std::ldexp(all * double(batch_), -60));
}

/// Short runs that are thrown away: where fans of rays pay, and where they should aim.
void Walk::learn() {
  // A sixteenth of what a short run is to do.
  const double run = openEnded() ? 1e9 : targetPhotons();
  const auto blocks = uint64_t(std::clamp(run / (16 * double(kBlock)), 1.0, double(kPilotBlocks)));
  guide_ = std::make_unique<WalkGuide>(kPilotChance);
  // The second round sees what fans add that already aim well.
  for (uint64_t round = 0; round < 2; ++round) {
    std::vector<WalkGuideSamples> parts(blocks);
    const WalkTally tally = traceBlocks(*guide_, nullptr, kPilotStream + round * blocks, blocks, &parts);
    WalkGuideSamples samples;
    for (const WalkGuideSamples& part : parts) samples.merge(part);
    const double work = (tally.cost() - tally.fans) / tally.photons;
    if (round == 0) emission_.guide(samples.startImportance());
    guide_ = std::make_unique<WalkGuide>(samples, tally.photons, work);
  }
}

WalkTally Walk::traceBlocks(const WalkGuide& guide, WalkFilm* film, uint64_t first, uint64_t count,
                            std::vector<WalkGuideSamples>* learn) const {
  std::vector<WalkTally> tallies(count);
  tbb::parallel_for(uint64_t(0), count, [&](uint64_t b) {
    WalkPhotons photons(world_, guide, film, learn ? &(*learn)[b] : nullptr,
                        Rng(settings_.seed, 2 * (first + b)));
    Rng jitter(settings_.seed, 2 * (first + b) + 1);
    // Three blocks in a row draw each stratum's paths for all channels, as PathWeight takes it.
    const uint64_t block = first + b;
    const uint64_t turn = Rng(settings_.seed, kTurnStream + block / 3).below(3) + block;
    for (uint64_t i = 0; i < kBlock; ++i)
      photons.fly((double(i) + double(jitter.uniform())) / double(kBlock), int((i + turn) % 3));
    tallies[b] = photons.tally();
  });
  WalkTally sum;
  for (const WalkTally& tally : tallies) sum += tally;
  return sum;
}

/// False when stopped in its middle; what was traced until then is kept.
bool Walk::traceBatch(const Progress& progress) {
  const uint64_t count = batch_ / kBlock;
  const uint64_t wave = uint64_t(tbb::this_task_arena::max_concurrency()) * 4;
  uint64_t done = 0;
  bool go = true;
  while (go && done < count) {
    const uint64_t now = std::min(wave, count - done);
    tally_ += traceBlocks(*guide_, film_.get(), blocks_, now, nullptr);
    blocks_ += now;
    done += now;
    go = report(progress) && !(settings_.timeLimit > 0 && seconds() >= settings_.timeLimit);
  }
  flush(double(done * kBlock), done == count);
  return go;
}

void Walk::flush(double photons, bool whole) {
  tbb::parallel_for(size_t(0), pixels(), [&](size_t i) {
    multiple_.add(i, glm::vec3(film_->take(i, 0) / photons), photons, whole);
    if (world_.radiosity) radiosity_.add(i, glm::vec3(film_->take(i, 1) / photons), photons, whole);
  });
  multiple_.finishBatch(photons, whole);
  radiosity_.finishBatch(photons, whole);
}

void Walk::passSingle() {
  std::vector<glm::vec3> radiance(pixels(), glm::vec3(0));
  singleLight_.pass(uint64_t(single_.weight()), settings_.seed, -1, radiance);
  for (size_t i = 0; i < radiance.size(); ++i) single_.add(i, radiance[i], 1);
  single_.finishBatch(1);
}

/// Standard error over mean, both over the covered pixels and RGB together; of multiple and single as asked
/// for.
double Walk::noise() const {
  double variance = 0, mean = 0, count = 0;
  for (size_t i = 0; i < pixels(); ++i) {
    if (receivers_.covered[i] == 0) continue;
    glm::vec3 m(0), v(0);
    if (settings_.components.multiple) m += multiple_.mean(i), v += multiple_.variance(i);
    if (settings_.components.single) m += single_.mean(i), v += single_.variance(i);
    variance += double(v.x + v.y + v.z);
    mean += double(m.x + m.y + m.z);
    count += 3;
  }
  return mean > 0 ? std::sqrt(variance * count) / mean : 0;
}

double Walk::progressMade() const {
  double made = openEnded() ? 0 : multiple_.weight() / targetPhotons();
  if (settings_.timeLimit > 0) made = std::max(made, seconds() / settings_.timeLimit);
  if (settings_.noise > 0 && multiple_.batches() >= 4) {
    const double now = noise();
    made = std::max(made, now > 0 ? std::pow(settings_.noise / now, 2) : 1);
  }
  return made;
}

bool Walk::report(const Progress& progress) const {
  const double photons = double(blocks_ * kBlock), perPixel = photons / double(pixels());
  const double passed = seconds(), fraction = openEnded() ? progressMade() : photons / targetPhotons();
  std::string detail = fmt::format("{:.3g} photons a pixel", perPixel);
  if (multiple_.batches() >= 2) detail += fmt::format(", noise {:.2g} %", 100 * noise());
  if (fraction > 1e-9 && fraction < 1) detail += fmt::format(", {:.0f} s to go", passed * (1 / fraction - 1));
  return progress.update({"walk", std::min(fraction, 1.0), detail});
}

bool Walk::run(const Progress& progress) {
  const bool photons = settings_.components.multiple || world_.radiosity;
  bool go = true;
  if (photons && !emission_.empty()) {
    learn();
    // Something is traced however short the time.
    while (go && (multiple_.weight() == 0 || !enough())) {
      go = traceBatch(progress);
      while (go && settings_.components.single &&
             single_.weight() < 1 + multiple_.weight() / double(pixels()))
        passSingle();
    }
  }
  // Few passes are little work, and four make a mean of which the error can be told.
  const double least = photons ? 4 : std::max(4.0, settings_.samples);
  while (settings_.components.single && single_.weight() < least) {
    passSingle();
    if (!photons && !progress.update({"walk", single_.weight() / least, "single scattering"})) return false;
  }
  return go || (settings_.timeLimit > 0 && seconds() >= settings_.timeLimit);
}

std::string Walk::fingerprint() const {
  const size_t hash = std::hash<std::string>{}(sceneToToml(rays_.scene()));
  return fmt::format("{:016x} {}x{}", hash, settings_.width, settings_.height);
}

void Walk::resume(const Image& image) {
  const auto print = image.metadata.find("state.fingerprint");
  if (image.width() != settings_.width || image.height() != settings_.height ||
      print == image.metadata.end() || print->second != fingerprint())
    throw Error(
        {.where = "--resume",
         .expected = "a walk's picture of the same scene, resolution and settings",
         .found = print == image.metadata.end() ? "no state in it" : "one of another scene or settings",
         .todo = "use the scene and the flags that the picture was made with"});
  if (settings_.components.multiple || world_.radiosity) multiple_.load(image, "state.multiple");
  if (settings_.components.single) single_.load(image, "state.single");
  if (world_.radiosity) radiosity_.load(image, "state.radiosity");
  blocks_ = uint64_t(std::strtod(image.metadata.at("state.blocks").c_str(), nullptr));
}

Image Walk::picture(bool finished, bool keepState) const {
  PictureParts parts;
  std::vector<glm::vec3> error(pixels());
  const auto mean = [&](const LayerMean& layer) {
    std::vector<glm::vec3> values(pixels());
    for (size_t i = 0; i < values.size(); ++i) {
      values[i] = layer.mean(i);
      error[i] += layer.variance(i);
    }
    return values;
  };
  if (settings_.components.multiple) parts.multiple = mean(multiple_);
  if (settings_.components.single) parts.single = mean(single_);
  if (settings_.components.surface) parts.surface = surfacePart(rays_, receivers_);
  Image image = assemblePicture(rays_, receivers_, settings_, parts);
  for (glm::vec3& e : error) e = glm::sqrt(e);
  if (settings_.wants("stderr")) addLayer(image, "stderr", error);
  if (world_.radiosity) {
    std::vector<glm::vec3> values(pixels());
    for (size_t i = 0; i < values.size(); ++i) values[i] = radiosity_.mean(i);
    addLayer(image, "radiosity", values);
  }
  describe(image);
  if (!finished) image.metadata["interrupted"] = "true";
  if (keepState) saveState(image);
  return image;
}

void Walk::describe(Image& image) const {
  image.metadata["photons"] = fmt::format("{}", multiple_.weight());
  image.metadata["photons_per_pixel"] = fmt::format("{:.6g}", multiple_.weight() / double(pixels()));
  image.metadata["batches"] = fmt::format("{}", multiple_.batches());
  image.metadata["single_passes"] = fmt::format("{}", single_.weight());
  image.metadata["noise"] = fmt::format("{:.6g}", noise());
  image.metadata["seconds"] = fmt::format("{:.3f}", seconds());
  const auto share = [&](const Rgb& flux) {
    const Rgb s = flux / glm::max(tally_.arrived, Rgb(1e-300));
    return fmt::format("{:.6g} {:.6g} {:.6g}", s.x, s.y, s.z);
  };
  image.metadata["escaped"] = share(tally_.escaped);
  image.metadata["absorbed"] = share(tally_.absorbed);
  image.metadata["blocked"] = share(tally_.blocked);
  image.metadata["lost"] = share(tally_.lost);
  image.metadata["ended"] = share(tally_.ended);
}

void Walk::saveState(Image& image) const {
  multiple_.save(image, "state.multiple");
  single_.save(image, "state.single");
  if (world_.radiosity) radiosity_.save(image, "state.radiosity");
  image.metadata["state.blocks"] = fmt::format("{}", blocks_);
  image.metadata["state.fingerprint"] = fingerprint();
}

}  // namespace

Image renderWalk(const RayScene& rays, const CameraReceivers& receivers, const RenderSettings& settings,
                 const ReferenceOptions& options, const Progress& progress, const LogSink& log) {
  Walk walk(rays, receivers, settings, log);
  if (options.resume) walk.resume(*options.resume);
  const bool finished = walk.run(progress);
  return walk.picture(finished, options.keepState);
}

}  // namespace lychnite
