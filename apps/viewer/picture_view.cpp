#include "picture_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lychnite/gpu/context.h"
#include "lychnite/scene/scene_file.h"
#include "technique/read_back.h"
#include "technique/renderer_textures.h"

namespace lychnite::viewer {
namespace {

constexpr double kRestAfter = 0.12;      // seconds without a change until the full resolution is drawn
constexpr double kWalkAfter = 0.5;       // and until the walk begins
constexpr double kMillisecondsIdle = 8;  // of a frame that draws no new picture, until one was measured

double meanOf(const Image& image) {
  double sum = 0, weight = 0;
  const std::vector<float>* alpha = image.has("A") ? &image.channel("A") : nullptr;
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    const glm::vec3 rgb = image.rgb(i);
    const double a = alpha ? double((*alpha)[i]) : 1;
    sum += a * double(rgb.r + rgb.g + rgb.b) / 3;
    weight += a;
  }
  return weight > 0 ? sum / weight : 1;
}

}  // namespace

void Pace::measured(double ms, double idleMs) {
  const double perFull = std::max(ms - idleMs, 0.1) / (scale_ * scale_);
  for (const double next : {1.0, 0.75, 0.5, 0.375, 0.25, 0.1875}) {
    // Growing asks for more room than staying, or the scale would swing.
    const double target = next > scale_ ? 0.8 * kTargetMs : 1.25 * kTargetMs;
    if (idleMs + perFull * next * next > target && next > 0.1875) continue;
    scale_ = next;
    return;
  }
}

PictureView::PictureView(const RendererOptions& options, const BackgroundWalk::Options& walk)
    : live_(options, {.threads = walk.threads, .yields = walk.yields}),
      variant_(options, {.threads = walk.threads, .yields = walk.yields}),
      pace_(gpu::Context({.current = true}).device().software),
      walk_(walk),
      samplerError_(options, walk.threads, walk.yields),
      idleMs_(kMillisecondsIdle) {
  live_.prepare();
}

void PictureView::warmUp(const gpu::Framebuffer& target, const Area& area) {
  const glm::ivec2 pixels(area.size());
  if (pixels.x <= 0 || pixels.y <= 0) return;
  const ViewState state = defaultView(loadObject("stone"));
  live_.update(state, {.pixels = pixels, .scale = pace_.scale()});
  show(target, area, state);
  live_.restart();
}

bool PictureView::compares(Source source) const {
  return compare_.mode != CompareView::Mode::kOff && (compare_.left == source || compare_.right == source);
}

void PictureView::update(const Request& asked) {
  const ViewState& state = *asked.state;
  Request request = asked;
  request.pixels =
      glm::max(glm::ivec2(glm::round(glm::dvec2(asked.pixels) * state.resolution)), glm::ivec2(1));
  compare_ = state.compare;
  const ViewState variant = compares(Source::kVariant) ? applied(state.variant, state) : ViewState{};
  std::string key = pictureKey(state, request.pixels);
  if (compares(Source::kVariant)) key += pictureKey(variant, request.pixels);
  if (key != key_ || request.moving) changedAt_ = request.seconds;
  key_ = std::move(key);
  const bool rest = !request.moving && request.seconds - changedAt_ >= kRestAfter;
  const LivePicture::Wish wish{.pixels = request.pixels,
                               .scale = pace_.scale(),
                               .rest = rest,
                               .seconds = request.seconds,
                               .compares = compare_.mode != CompareView::Mode::kOff};
  drew_ = live_.update(state, wish);
  if (compares(Source::kVariant)) drew_ |= variant_.update(variant, wish);
  const bool whole = live_.whole() && (!compares(Source::kVariant) || variant_.whole());
  if (!rest || !whole) restedAt_ = 1e300;
  if (rest && whole) restedAt_ = std::min(restedAt_, request.seconds);
  updateWalk(request);
  updateFile(request);
  settled_ = rest && whole && !drew_;
  atRest_ = settled_ && live_.complete() && (!compares(Source::kVariant) || variant_.complete()) &&
            (!compares(Source::kTruth) || walkTexture_ || !walk_.problem().empty());
  updateError(request);
  if (measuring_.valid()) atRest_ = false;
  if (!request.judge || request.moving)
    samplerError_.stop();
  else if (settled_)
    samplerError_.want(state, double(request.pixels.x) / std::max(1, request.pixels.y));
  if (request.judge && samplerError_.pending()) atRest_ = false;
}

void PictureView::updateWalk(const Request& request) {
  ViewState judged;
  judged.scene = request.state->scene;
  judged.settings.components = request.state->settings.components;
  std::string key = compares(Source::kTruth) ? pictureKey(judged, request.pixels) : "";
  if (key != walkKey_) {
    walk_.stop();
    walkTexture_.reset();
    shownWalk_.reset();
    walkBegun_ = false;
    walkKey_ = std::move(key);
  }
  if (walkKey_.empty()) return;
  // Anything else has the processor first. What has begun goes on until the scene is another.
  walkBegun_ |= !request.moving && request.seconds - restedAt_ >= kWalkAfter;
  if (!walkBegun_) return;
  RenderSettings settings;
  settings.width = request.pixels.x;
  settings.height = request.pixels.y;
  settings.components = request.state->settings.components;
  walk_.want(request.state->scene, settings);
  auto newest = walk_.newest();
  if (!newest || (shownWalk_ && newest->image == shownWalk_->image)) return;
  walkTexture_ = uploaded(*newest->image, "walk");
  shownWalk_ = std::move(newest);
}

void PictureView::updateFile(const Request& request) {
  if (request.file == fileImage_) return;
  fileImage_ = request.file;
  fileTexture_.reset();
  if (fileImage_ && fileImage_->hasRgb()) fileTexture_ = uploaded(*fileImage_, "opened picture");
}

const gpu::Texture* PictureView::textureOf(Source source) const {
  switch (source) {
    case Source::kView:
      return live_.ready() ? &live_.texture() : nullptr;
    case Source::kVariant:
      return variant_.ready() ? &variant_.texture() : nullptr;
    case Source::kTruth:
      return walkTexture_ ? &*walkTexture_ : nullptr;
    case Source::kFile:
      return fileTexture_ ? &*fileTexture_ : nullptr;
  }
  return nullptr;
}

std::string PictureView::labelOf(Source source) const {
  if (source == Source::kView) return live_.label();
  if (source == Source::kVariant && compares(source)) return variant_.label();
  if (source != Source::kTruth || !shownWalk_) return "";
  return fmt::format("noise {:.1f} %, {:.0f} s", 100 * shownWalk_->noise, shownWalk_->seconds);
}

std::string PictureView::keyOf(Source source) const {
  if (source == Source::kView) return live_.key();
  if (source == Source::kVariant) return variant_.key();
  return fmt::format("{}", fmt::ptr(source == Source::kFile ? fileImage_.get()
                                    : shownWalk_            ? shownWalk_->image.get()
                                                            : nullptr));
}

std::shared_ptr<const Image> PictureView::imageOf(Source source) const {
  if (source == Source::kTruth) return shownWalk_->image;
  if (source == Source::kFile) return fileImage_;
  if (const auto& ready = (source == Source::kView ? live_ : variant_).image()) return ready;
  const gpu::Texture& texture = *textureOf(source);
  auto image = std::make_shared<Image>(texture.width(), texture.height());
  readPicture(texture, *image);
  return image;
}

/// The metrics take longer than a frame may, so they are found on another thread.
void PictureView::updateError(const Request& request) {
  if (measuring_.valid() && measuring_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    const Measured done = measuring_.get();
    errorProblem_ = done.problem;
    meanOfRight_ = done.meanOfRight;
    error_ = done.problem.empty() ? std::optional(done.metrics) : std::nullopt;
  }
  if (compare_.mode == CompareView::Mode::kOff || !atRest_) return;
  if (!available(compare_.left) || !available(compare_.right) || measuring_.valid()) return;
  const double exposure = request.state->toneMapping.exposure;
  const std::string key = keyOf(compare_.left) + "|" + keyOf(compare_.right) + fmt::format("|{}", exposure);
  if (key == measuredKey_) return;
  measuredKey_ = key;
  error_.reset();
  measuring_ = std::async(
      std::launch::async, [left = imageOf(compare_.left), right = imageOf(compare_.right), exposure] {
        lowerThreadPriority();
        Measured result;
        try {
          result.meanOfRight = meanOf(*right);
          result.metrics =
              compare(*left, *right, {.exposure = exposure, .useStandardError = right->hasRgb("stderr")})
                  .together;
        } catch (const std::exception& error) {
          result.problem = error.what();
        }
        return result;
      });
}

std::optional<Display::Layer> PictureView::layerOf(const ViewState& state) {
  const Inspect& inspect = state.inspect;
  if (inspect.layer == Inspect::Layer::kPicture) return {};
  if (inspect.layer != Inspect::Layer::kMap) {
    Display::Layer layer{.kind = inspect.layer == Inspect::Layer::kDepth ? 1 : 2,
                         .texture = &RendererTextures::geometry(live_.renderer())};
    const Sphere sphere = boundingSphere(state.scene);
    const CameraFrame camera = cameraFrame(state.scene, 1, 1);
    const double unit = state.scene.objects[subjectIndex(state.scene)].size;
    const double middle = glm::dot(sphere.centre - camera.position, camera.forward);
    layer.low = (middle - sphere.radius) / unit;
    layer.high = (middle + sphere.radius) / unit;
    return layer;
  }
  return mapLayer(state, subjectIndex(state.scene), inspect.mapLevel);
}

std::optional<Display::Layer> PictureView::mapLayer(const ViewState& state, size_t object, int level) {
  if (state.scene.lights.empty()) return {};
  const size_t light = size_t(std::clamp(state.inspect.light, 0, int(state.scene.lights.size()) - 1));
  const LightMapPass::Map& map = RendererTextures::maps(live_.renderer()).get(object, light);
  const bool flux = map.moments.has_value();
  const gpu::Texture* texture = flux ? &*map.moments : map.cosine ? &*map.cosine : nullptr;
  if (!texture) return {};
  mapLevels_ = texture->levels();
  return Display::Layer{
      .kind = flux ? 3 : 4, .texture = texture, .level = double(std::min(level, mapLevels_ - 1))};
}

const std::optional<SeenSamples>& PictureView::samplesAt(const glm::dvec2& place, const ViewState& state) {
  static const std::optional<SeenSamples> kNone;
  const CompareView& compare = state.compare;
  Source source = Source::kView;
  if (compare.mode == CompareView::Mode::kWipe)
    source = place.x > compare.wipe ? compare.right : compare.left;
  LivePicture* picture = source == Source::kView ? &live_ : source == Source::kVariant ? &variant_ : nullptr;
  const size_t light = size_t(std::max(0, state.inspect.light));
  const auto& found = picture && picture->ready() ? picture->samplesAt(place, light) : kNone;
  seen_ = found ? &found : nullptr;
  return found;
}

void PictureView::show(const gpu::Framebuffer& target, const Area& area, const ViewState& state) {
  const auto seen = std::exchange(seen_, nullptr);
  if (!live_.ready()) return;
  const auto rect = [&](const Area& part) {
    return gpu::Rect{int(part.low.x), target.height() - int(part.high.y), int(part.size().x),
                     int(part.size().y)};
  };
  Display::Frame frame{.area = rect(area),
                       .compare = state.compare,
                       .meanOfRight = meanOfRight_,
                       .toneMapping = state.toneMapping};
  frame.left = &live_.texture();
  if (state.compare.mode != CompareView::Mode::kOff) {
    if (const gpu::Texture* left = textureOf(state.compare.left)) frame.left = left;
    frame.right = textureOf(state.compare.right);
  }
  frame.layer = layerOf(state);
  if (state.ruler) frame.grid = &shownScene(state);
  display_.draw(target, frame);
  if (!seen || !*seen || (*seen)->object >= state.scene.objects.size()) return;
  Display::Frame inset{.area = rect(mapInset(area)), .left = frame.left};
  inset.layer = mapLayer(state, (*seen)->object, 0);
  if (inset.layer) display_.draw(target, inset);
}

const Scene& PictureView::shownScene(const ViewState& state) const {
  const Scene* older = live_.shownScene();
  return older ? *older : state.scene;
}

Area mapInset(const Area& picture) {
  const double side = std::floor(0.34 * std::min(picture.size().x, picture.size().y)),
               gap = std::floor(0.05 * side);
  const glm::dvec2 low(picture.low.x + gap, picture.high.y - gap - side);
  return {low, low + glm::dvec2(side)};
}

void PictureView::frameTook(double ms) {
  if (drew_)
    pace_.measured(ms, idleMs_);
  else
    idleMs_ += 0.2 * (std::min(ms, 30.0) - idleMs_);
}

std::vector<std::string> PictureView::takeProblems() {
  std::vector<std::string> problems;
  for (LivePicture* picture : {&live_, &variant_})
    if (std::string problem = picture->takeProblem(); !problem.empty())
      problems.push_back(std::move(problem));
  return problems;
}

void PictureView::forget() {
  live_.forget();
  variant_.forget();
}

}  // namespace lychnite::viewer
