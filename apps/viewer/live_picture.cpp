#include "live_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "lychnite/base/error.h"

namespace lychnite::viewer {

std::string pictureKey(const ViewState& state, glm::ivec2 pixels) {
  ViewState plain;
  plain.scene = state.scene;
  plain.settings = state.settings;
  return fmt::format("{}x{} {}", pixels.x, pixels.y, fingerprint(plain));
}

gpu::Texture uploaded(const Image& image, const char* label) {
  const int width = image.width(), height = image.height();
  std::vector<float> texels(image.pixelCount() * 4);
  const std::vector<float>* alpha = image.has("A") ? &image.channel("A") : nullptr;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const size_t from = size_t(height - 1 - y) * size_t(width) + size_t(x);
      const glm::vec3 rgb = image.rgb(from);
      float* to = &texels[(size_t(y) * size_t(width) + size_t(x)) * 4];
      to[0] = rgb.r, to[1] = rgb.g, to[2] = rgb.b, to[3] = alpha ? (*alpha)[from] : 1;
    }
  }
  gpu::Texture texture({.label = label, .format = gpu::Format::kRgba32f, .width = width, .height = height});
  texture.upload(std::span<const float>(texels));
  return texture;
}

bool LivePicture::update(const ViewState& state, const Wish& wish) {
  key_ = pictureKey(state, wish.pixels);
  updateVolume(state, wish);
  // A layer shows what the drawn method is made from.
  if (showsVolume_ && drawn_ && state.inspect.layer == Inspect::Layer::kPicture) return false;
  return drawNow(state, wish);
}

bool LivePicture::drawNow(const ViewState& state, const Wish& wish) {
  const double wanted = wish.rest ? 1 : wish.scale;
  const bool changed = key_ != drawnKey_;
  if (!changed && drawn_ && drawnScale_ >= wanted) return false;
  prepare();
  RenderSettings settings = state.settings;
  if (settings.method == Method::kVolume) settings.method = Method::kMatched;
  settings.aovs.clear();
  settings.width = std::max(1, int(std::lround(wish.pixels.x * wanted)));
  settings.height = std::max(1, int(std::lround(wish.pixels.y * wanted)));
  drawnKey_ = key_;
  drawnScale_ = wanted;
  try {
    renderer_->draw(state.scene, settings);
    drawn_ = true;
    drawnScene_ = state.scene;
    drawnSettings_ = settings;
  } catch (const Error& error) {
    if (error.kind() == Error::Kind::kDevice) throw;
    // A scene that a hand made and the method cannot draw (a point light inside the object): the picture
    // stays.
    if (changed) problem_ = error.what();
  }
  return true;
}

const std::optional<SeenSamples>& LivePicture::samplesAt(const glm::dvec2& place, size_t light) {
  const RenderSettings& s = drawnSettings_;
  const glm::ivec2 pixel(std::clamp(int(place.x * s.width), 0, s.width - 1),
                         std::clamp(int((1 - place.y) * s.height), 0, s.height - 1));
  std::string key = fmt::format("{} {} {} {} {}", drawnKey_, drawnScale_, pixel.x, pixel.y, light);
  if (key == seenKey_) return seen_;
  seenKey_ = std::move(key);
  seen_.reset();
  if (drawn_ && !wantsVolume_)
    seen_ = RendererTextures::samplesAt(*renderer_, drawnScene_, drawnSettings_, pixel, light);
  return seen_;
}

namespace {

/// The object stands in both pictures at the same place.
bool sameView(const Scene& a, const Scene& b) {
  const auto eyeOf = [](const Scene& scene) {
    const Object& subject = scene.objects[subjectIndex(scene)];
    const CameraFrame camera = cameraFrame(scene, 1, 1);
    return std::pair((camera.position - subject.position) / subject.size, camera.forward);
  };
  const auto [eyeA, forwardA] = eyeOf(a);
  const auto [eyeB, forwardB] = eyeOf(b);
  return glm::distance(eyeA, eyeB) < 1e-6 && glm::distance(forwardA, forwardB) < 1e-6;
}

/// The same bodies in a picture of the same shape: an older picture may stand for the newest a moment.
bool alike(const Scene& a, const Scene& b, const Image& picture, glm::ivec2 pixels) {
  if (a.objects.size() != b.objects.size()) return false;
  for (size_t i = 0; i < a.objects.size(); ++i)
    if (a.objects[i].mesh != b.objects[i].mesh) return false;
  const double wide = double(picture.width()) / picture.height(), now = double(pixels.x) / pixels.y;
  return std::abs(wide / now - 1) < 0.02;
}

}  // namespace

/// Whether the volume's newest picture stays on the window while the scene moves on.
bool LivePicture::keepsUp(const ViewState& state, const Wish& wish) {
  if (!volumeTexture_) return false;
  // At rest there is no pace: the full picture may take its time.
  const bool follows = volumePace_.follows(volumeImage_.get(), volumeBehind_ && !wish.rest, wish.seconds);
  return follows && alike(volumeScene_, state.scene, *volumeImage_, wish.pixels) &&
         (!wish.compares || sameView(volumeScene_, state.scene));
}

/// Solves for the scene at rest in full, and coarser for one in motion as long as that keeps up.
void LivePicture::updateVolume(const ViewState& state, const Wish& wish) {
  wantsVolume_ = state.settings.method == Method::kVolume;
  if (!wantsVolume_) {
    if (volume_) volume_->stop();
    forgetVolume();
    return;
  }
  if (!volume_) volume_ = std::make_unique<BackgroundVolume>(volumeOptions_);
  RenderSettings settings = state.settings;
  settings.width = wish.pixels.x;
  settings.height = wish.pixels.y;
  volumeBehind_ = volumeKey_ != key_;
  const bool keeps = keepsUp(state, wish);
  if (!wish.rest && !keeps) {
    volume_->stop();
    forgetVolume();
    solving_ = true;
    return;
  }
  // Also of the scene that has just come to rest, until what is shown is of it.
  const bool coarse = !wish.rest || (volumeBehind_ && keeps);
  if (coarse) {
    settings.width = std::max(8, int(std::lround(wish.pixels.x * volumePace_.share())));
    settings.height = std::max(8, int(std::lround(wish.pixels.y * volumePace_.share())));
  }
  if (wish.rest || volumeBehind_) volume_->want(state.scene, settings, coarse);
  const auto newest = volume_->newest();
  const bool current = newest && !newest->behind;
  const std::string obstacle = current ? newest->obstacle : volume_->problem();
  const bool known = current || !obstacle.empty();
  if (known && obstacle != std::exchange(obstacle_, obstacle) && !obstacle.empty())
    problem_ = "volume: " + obstacle + "; shown by matched instead";
  if (newest && newest->image && newest->image != volumeImage_) takeVolume(*newest, state, wish);
  showsVolume_ = volumeTexture_ && obstacle_.empty() && (current || keeps);
  solving_ = coarse || !known;
}

void LivePicture::takeVolume(const BackgroundVolume::Result& newest, const ViewState& state,
                             const Wish& wish) {
  volumeImage_ = newest.image;
  volumeScene_ = newest.scene;
  passes_ = newest.passes;
  volumeTexture_ = uploaded(*volumeImage_, "volume");
  // What motion costs: where views change all the time a new one each, else one that is kept.
  if (newest.preview && (std::exchange(newView_, newest.newView) || !newest.newView))
    volumePace_.measured(newest.pictureSeconds, double(volumeImage_->width()) / wish.pixels.x);
  ViewState shown;
  shown.scene = newest.scene;
  shown.settings = state.settings;
  volumeKey_ = pictureKey(shown, wish.pixels);
}

void LivePicture::forgetVolume() {
  volumeTexture_.reset();
  volumeImage_.reset();
  volumeKey_.clear();
  passes_ = 0;
  solving_ = showsVolume_ = volumeBehind_ = false;
}

const gpu::Texture& LivePicture::texture() const {
  return showsVolume_ ? *volumeTexture_ : RendererTextures::picture(*renderer_);
}

std::string LivePicture::label() const {
  if (!wantsVolume_) return "";
  if (showsVolume_) return solving_ || passes_ == 0 ? "volume" : fmt::format("volume, pass {}", passes_);
  return solving_ ? "matched, until volume is solved" : "matched, because volume cannot be solved";
}

std::string LivePicture::key() const {
  return fmt::format("{} {}", key_, fmt::ptr(image().get()));
}

void LivePicture::forget() {
  renderer_.reset();
  restart();
}

void LivePicture::restart() {
  forgetVolume();
  key_.clear();
  drawnKey_.clear();
  seenKey_.clear();
  seen_.reset();
  drawn_ = false;
  drawnScale_ = 0;
}

}  // namespace lychnite::viewer
