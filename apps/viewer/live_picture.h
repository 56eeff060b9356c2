#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "gpu/texture.h"
#include "lychnite/app/background.h"
#include "lychnite/app/follow_pace.h"
#include "lychnite/app/view_state.h"
#include "lychnite/technique/renderer.h"
#include "technique/renderer_textures.h"

namespace lychnite::viewer {

/// All that a picture of the scene depends on.
std::string pictureKey(const ViewState& state, glm::ivec2 pixels);
/// Linear radiance and coverage, row 0 lowest as everywhere on the device.
gpu::Texture uploaded(const Image& image, const char* label);

/// One picture that follows its scene: coarse while things move, whole at rest. `volume` is solved behind it;
/// its newest picture is shown as long as it keeps up, and `matched` stands in where it does not.
class LivePicture {
 public:
  LivePicture(const RendererOptions& options, const BackgroundVolume::Options& volume)
      : options_(options), volumeOptions_(volume) {}

  struct Wish {
    glm::ivec2 pixels{0};
    double scale = 1;  ///< of a picture drawn in motion
    bool rest = false;
    double seconds = 0;     ///< now
    bool compares = false;  ///< beside another one: it is never of an older view
  };
  /// Draws what changed; rest asks for the full resolution. True when something was drawn.
  bool update(const ViewState& state, const Wish& wish);
  /// Makes the renderer (compiles its shaders) before it is needed.
  void prepare() {
    if (!renderer_) renderer_ = std::make_unique<Renderer>(options_);
  }
  /// Makes the next picture anew, with a new renderer or the same.
  void forget();
  void restart();
  bool ready() const { return drawn_; }
  bool whole() const { return ready() && (showsVolume_ || drawnScale_ >= 1); }
  /// What is asked for is not a stand-in's picture any more, nor an older one.
  bool complete() const { return whole() && !solving_; }
  /// The scene as the picture shows it where that is an older one.
  const Scene* shownScene() const { return showsVolume_ ? &volumeScene_ : nullptr; }
  const gpu::Texture& texture() const;
  /// The same on the processor, where it is there anyway.
  std::shared_ptr<const Image> image() const { return showsVolume_ ? volumeImage_ : nullptr; }
  /// "volume, pass 3", or what stands in for it; "" for a real-time method.
  std::string label() const;
  const Renderer& renderer() const { return *renderer_; }
  /// The samples behind the place (shares from the upper left) of the picture that is drawn, kept until it or
  /// the place changes. Nothing off the objects and for `volume`.
  const std::optional<SeenSamples>& samplesAt(const glm::dvec2& place, size_t light);
  const RenderStats& stats() const { return renderer_->stats(); }
  /// Why the newest state could not be drawn (once); the picture is then an older one.
  std::string takeProblem() { return std::exchange(problem_, {}); }
  /// Changes with everything that the picture shows.
  std::string key() const;

 private:
  void updateVolume(const ViewState& state, const Wish& wish);
  void forgetVolume();
  void takeVolume(const BackgroundVolume::Result& newest, const ViewState& state, const Wish& wish);
  bool keepsUp(const ViewState& state, const Wish& wish);
  bool drawNow(const ViewState& state, const Wish& wish);

  RendererOptions options_;
  BackgroundVolume::Options volumeOptions_;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<BackgroundVolume> volume_;
  std::optional<gpu::Texture> volumeTexture_;
  std::shared_ptr<const Image> volumeImage_;
  Scene volumeScene_;
  FollowPace volumePace_;
  int passes_ = 0;
  bool newView_ = false;  ///< the newest picture of the volume was the first of its view
  Scene drawnScene_;
  RenderSettings drawnSettings_;
  std::string seenKey_;
  std::optional<SeenSamples> seen_;
  std::string key_, drawnKey_, volumeKey_, problem_, obstacle_;
  bool drawn_ = false, solving_ = false, wantsVolume_ = false;
  bool showsVolume_ = false;   ///< and not what is drawn
  bool volumeBehind_ = false;  ///< the volume's picture is of an older scene
  double drawnScale_ = 0;
};

}  // namespace lychnite::viewer
