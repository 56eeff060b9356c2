#include "app/paper/studio.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "lychnite/base/error.h"
#include "lychnite/image/io.h"
#include "lychnite/mesh/builtin.h"
#include "lychnite/optics/profile.h"
#include "lychnite/scene/scene_file.h"

namespace lychnite::paper {
namespace {

namespace fs = std::filesystem;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool isRealTime(Method method) {
  return !isReference(method) && method != Method::kVolume;
}

/// All of the settings that any method reads; threads and the layers asked for change no pixel.
std::string textOf(const RenderSettings& s) {
  std::string text = fmt::format(
      "{}x{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", s.width, s.height,
      methodName(s.method), profileName(s.profile), componentsName(s.components), s.multipleSamples,
      s.interpolation, s.lattice.C1, s.lattice.C2, s.lattice.K, s.singleSamples, s.mapSize, s.mostMapSize,
      s.samples, s.tolerance, s.timeLimit, s.noise, s.cells, s.collisions, s.passes, s.seed);
  for (const std::string& aov : s.aovs) text += " " + aov;
  return text;
}

/// The scene with its first light a little aside: every cached product but the meshes is made anew.
Scene nudged(Scene scene, int by) {
  for (Light& light : scene.lights)
    if (auto* parallel = std::get_if<ParallelLight>(&light)) parallel->azimuth += 0.01 * by;
  return scene;
}

}  // namespace

std::string hashOf(std::string_view bytes) {
  uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : bytes) hash = (hash ^ uint8_t(c)) * 0x100000001b3u;
  return fmt::format("{:016x}", hash);
}

double exposureFor(const Image& image) {
  std::vector<float> light;
  for (size_t i = 0; i < image.pixelCount(); ++i)
    if (image.channel("A")[i] == 1)
      light.push_back(std::max({image.rgb(i).x, image.rgb(i).y, image.rgb(i).z}));
  if (light.empty()) return 0;
  const auto place = light.begin() + ptrdiff_t(light.size() * 98 / 100);
  std::nth_element(light.begin(), place, light.end());
  return std::log2(0.8 / std::max(double(*place), 1e-12));
}

glm::dvec3 meanColour(const Image& image) {
  glm::dvec3 sum(0);
  double count = 0;
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    if (image.channel("A")[i] < 1) continue;
    sum += glm::dvec3(image.rgb(i));
    count += 1;
  }
  return sum / std::max(count, 1.0);
}

Image displayed(const Image& image) {
  Image result = image;
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    const glm::vec3 c = image.rgb(i);
    result.setRgb(i, {linearFromSrgb(c.x), linearFromSrgb(c.y), linearFromSrgb(c.z)});
  }
  return result;
}

Image scaled(const Image& image, double factor) {
  Image result = image;
  for (size_t i = 0; i < image.pixelCount(); ++i) result.setRgb(i, image.rgb(i) * float(factor));
  return result;
}

void Studio::begin(const fs::path& folder, int work, const Progress& progress) {
  folder_ = folder;
  fs::create_directories(folder);
  files_.clear();
  progress_ = progress;
  steps_ = std::max(1, work);
  done_ = 0;
  begun_ = now();
  progress_.check({.what = "paper"});
}

void Studio::step(const std::string& what) {
  done_ = std::min(done_ + 1, steps_);
  progress_.check({.what = "paper", .fraction = double(done_) / steps_, .detail = what});
}

Progress Studio::within(const std::string& what) const {
  return Progress([=, progress = progress_, first = done_, all = steps_](const Progress::Update& update) {
    return progress.update({.what = "paper",
                            .fraction = std::min(1.0, (first + update.fraction) / all),
                            .detail = update.detail.empty() ? what : what + ", " + update.detail});
  });
}

Object Studio::object(const std::string& model) {
  if (const auto kept = objects_.find(model); kept != objects_.end()) return kept->second;
  const bool builtin = builtinMesh(model) != nullptr;
  const std::string path = builtin ? model : (settings_.models / (model + ".ply")).string();
  return objects_[model] = loadObject(path, ".", settings_.log);
}

std::string Studio::keyOf(const Scene& scene, const RenderSettings& settings) {
  std::string text = program_ + sceneToToml(scene) + textOf(settings);
  if (isRealTime(settings.method)) text += device_;
  for (const Object& object : scene.objects) {
    std::string& key = meshKeys_[object.mesh];
    if (key.empty())
      key = hashOf({reinterpret_cast<const char*>(object.mesh->positions.data()),
                    object.mesh->positions.size() * sizeof(glm::vec3)});
    text += key;
  }
  return hashOf(text);
}

double Studio::secondsOf(const Image& image) {
  const auto found = image.metadata.find("paper.seconds");
  return found == image.metadata.end() ? 0 : std::stod(found->second);
}

Image Studio::picture(const std::string& name, const Scene& scene, const RenderSettings& settings,
                      Timing timing) {
  const fs::path path = file(name + ".exr");
  const std::string key = keyOf(scene, settings) + (timing == Timing::kFrames ? "t" : "");
  Image image;
  bool found = false;
  if (fs::exists(path)) {
    try {
      image = readImage(path);
      found = image.metadata["paper.key"] == key;
    } catch (const Error&) {
      // Not ours, or damaged: it is made anew.
    }
  }
  if (!found) {
    image = settings.method == Method::kWalk ? walk(name, key, scene, settings)
                                             : render(name, scene, settings, timing);
    image.metadata["paper.key"] = key;
    writeExr(image, path);
  }
  step(name);
  return image;
}

Image Studio::render(const std::string& name, const Scene& scene, const RenderSettings& settings,
                     Timing timing) {
  const Progress progress = within(name);
  std::array<double, 3> frames{};
  const bool timeFrames = timing == Timing::kFrames && isRealTime(settings.method);
  if (timeFrames) {
    maker_.render(nudged(scene, int(frames.size()) + 1), settings, progress);
    for (size_t i = 0; i < frames.size(); ++i) {
      maker_.render(nudged(scene, int(frames.size() - i)), settings, progress);
      frames[i] = maker_.stats()->frameMs / 1000;
    }
    std::sort(frames.begin(), frames.end());
  }
  const double start = now();
  Image image = maker_.render(scene, settings, progress);
  image.metadata["paper.seconds"] = fmt::format("{:.6g}", timeFrames ? frames[1] : now() - start);
  return image;
}

/// A walk goes on from the picture that an interrupted run has left.
Image Studio::walk(const std::string& name, const std::string& key, const Scene& scene,
                   const RenderSettings& settings) {
  const fs::path unfinished = folder_ / ("." + name + ".unfinished.exr");
  Image before;
  if (fs::exists(unfinished)) {
    try {
      before = readImage(unfinished);
    } catch (const Error&) {
      before = {};
    }
    if (!before.empty() && before.metadata["paper.key"] != key) before = {};
  }
  const double earlier = before.empty() ? 0 : secondsOf(before), start = now();
  Image image = maker_.render(scene, settings, within(name),
                              {.resume = before.empty() ? nullptr : &before, .keepState = true});
  image.metadata["paper.seconds"] = fmt::format("{:.6g}", earlier + now() - start);
  if (image.metadata.contains("interrupted")) {
    image.metadata.erase("interrupted");
    image.metadata["paper.key"] = key;
    writeExr(image, unfinished);
    throw Interrupted();
  }
  fs::remove(unfinished);
  Image finished(image.width(), image.height());
  for (const auto& [channel, values] : image.channels())
    if (!channel.starts_with("state.")) finished.addChannel(channel) = values;
  for (const auto& [field, text] : image.metadata)
    if (!field.starts_with("state.")) finished.metadata[field] = text;
  return finished;
}

std::string Studio::show(const std::string& name, const Image& image, const ToneMapping& toneMapping) {
  const std::string png = name + ".png";
  writePng(image, file(png), {.toneMapping = toneMapping});
  return png;
}

fs::path Studio::file(const std::string& name) {
  files_.insert(name);
  return folder_ / name;
}

Renderer& Studio::renderer() {
  if (!renderer_) renderer_.emplace(RendererOptions{.useCurrentContext = true, .log = settings_.log});
  return *renderer_;
}

double Studio::seconds() const {
  return now() - begun_;
}

}  // namespace lychnite::paper
