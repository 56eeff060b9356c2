#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "area.h"
#include "display.h"
#include "live_picture.h"
#include "lychnite/app/background.h"
#include "lychnite/app/view_state.h"
#include "lychnite/image/metrics.h"
#include "sampler_error.h"

namespace lychnite::viewer {

/// The square in the lower left corner of the picture's area in which the light-space map is shown beside its
/// samples: pixels of the window from its upper left corner.
Area mapInset(const Area& picture);

/// Chooses the share of the full resolution at which a frame takes about `kTargetMs`.
class Pace {
 public:
  static constexpr double kTargetMs = 40;
  /// Software begins as coarse as it gets, for the sake of the first picture.
  explicit Pace(bool software) : scale_(software ? 0.1875 : 1) {}
  double scale() const { return scale_; }
  /// A frame that drew at scale() took `ms`, of which `idleMs` goes into frames that draw nothing.
  void measured(double ms, double idleMs);

 private:
  double scale_;
};

/// Everything in the picture's area of the window: the scene, its variant, the walk, an opened picture.
class PictureView {
 public:
  PictureView(const RendererOptions& options, const BackgroundWalk::Options& walk);
  /// Draws a small model and forgets it: drivers make their programs when they are first used.
  void warmUp(const gpu::Framebuffer& target, const Area& area);

  struct Request {
    const ViewState* state = nullptr;
    glm::ivec2 pixels{0};
    bool moving = false;  ///< a hand or an animation is on it
    double seconds = 0;   ///< now
    std::shared_ptr<const Image> file;
    bool judge = false;  ///< the sampler's error is asked for
  };
  /// Draws what the request needs that is not there yet.
  void update(const Request& asked);
  /// Puts it on the window. Nothing before the first update().
  void show(const gpu::Framebuffer& target, const Area& area, const ViewState& state);

  bool ready() const { return live_.ready(); }
  /// The scene as the picture shows it: a moment older where `volume` follows one in motion.
  const Scene& shownScene(const ViewState& state) const;
  /// All that is asked for is there at full resolution (the walk: a first picture of it).
  bool atRest() const { return atRest_; }
  /// There is a picture of that side, be it an older one.
  bool available(CompareView::Source source) const { return textureOf(source) != nullptr; }
  /// How the picture of a side is being made, "" when there is nothing to say.
  std::string labelOf(CompareView::Source source) const;
  /// The real-time pictures are there at full resolution; what is left goes on in the background.
  bool settled() const { return settled_; }
  /// A solver makes the picture better and better.
  bool refines() const { return !live_.label().empty() || !variant_.label().empty(); }
  /// The picture is a solver's that follows a scene in motion: frames alone make it no newer.
  bool follows() const { return live_.shownScene() && !live_.complete(); }
  /// The last update() drew; and how long its frame took, for the pace of the next ones.
  bool drew() const { return drew_; }
  void frameTook(double ms);
  /// Makes every picture anew, with new renderers.
  void forget();

  /// The samples behind a place of the picture as it was drawn last, on the side of a comparison that is
  /// there.
  const std::optional<SeenSamples>& samplesAt(const glm::dvec2& place, const ViewState& state);
  const RenderStats* stats() const { return live_.ready() ? &live_.stats() : nullptr; }
  /// The walk's picture that is shown.
  const std::optional<BackgroundWalk::Result>& walk() const { return shownWalk_; }
  std::string walkProblem() const { return walk_.problem(); }
  /// Of the scene's method, at rest, while it is asked for.
  SamplerError& samplerError() { return samplerError_; }
  /// Of left against right, when both are whole.
  const std::optional<Metrics>& error() const { return error_; }
  const std::string& errorProblem() const { return errorProblem_; }
  /// What could not be drawn, each once.
  std::vector<std::string> takeProblems();
  /// Mip levels of the light-space map shown.
  int mapLevels() const { return mapLevels_; }
  Display& display() { return display_; }

 private:
  using Source = CompareView::Source;
  bool compares(Source source) const;
  void updateWalk(const Request& request);
  void updateFile(const Request& request);
  void updateError(const Request& request);
  const gpu::Texture* textureOf(Source source) const;
  std::shared_ptr<const Image> imageOf(Source source) const;
  std::string keyOf(Source source) const;
  std::optional<Display::Layer> layerOf(const ViewState& state);
  std::optional<Display::Layer> mapLayer(const ViewState& state, size_t object, int level);

  struct Measured {
    Metrics metrics;
    double meanOfRight = 1;
    std::string problem;
  };

  Display display_;
  LivePicture live_, variant_;
  Pace pace_;
  BackgroundWalk walk_;
  SamplerError samplerError_;
  std::optional<BackgroundWalk::Result> shownWalk_;
  std::string walkKey_;
  bool walkBegun_ = false;
  std::optional<gpu::Texture> walkTexture_, fileTexture_;
  std::shared_ptr<const Image> fileImage_;
  CompareView compare_;
  double changedAt_ = -1e9, restedAt_ = 1e300, idleMs_ = 8;
  std::string key_;
  bool atRest_ = false, settled_ = false, drew_ = false;
  int mapLevels_ = 1;
  const std::optional<SeenSamples>* seen_ = nullptr;  ///< of this frame
  std::future<Measured> measuring_;
  std::string measuredKey_;
  std::optional<Metrics> error_;
  std::string errorProblem_;
  double meanOfRight_ = 1;
};

}  // namespace lychnite::viewer
