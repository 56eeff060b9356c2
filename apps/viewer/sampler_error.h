#pragma once

#include <memory>
#include <optional>
#include <string>

#include "lychnite/app/background.h"
#include "lychnite/app/view_state.h"
#include "lychnite/image/metrics.h"
#include "lychnite/technique/renderer.h"

namespace lychnite::viewer {

/// How far a real-time method is from the integral that it samples: multiple scattering in a small picture of
/// the scene, against the dipole's sum of the same profile over the lit surface.
class SamplerError {
 public:
  SamplerError(const RendererOptions& options, int threads, bool yields)
      : options_(options), dipole_(threads, yields) {}

  /// What to judge; draws when that is another scene. `aspect`: of the picture, width over height.
  void want(const ViewState& state, double aspect);
  /// Nothing to judge now: something moves.
  void stop();
  /// Nothing before it is found, and for what cannot be judged.
  const std::optional<Metrics>& found();
  bool pending() const { return sampled_ && !found_ && problem_.empty(); }
  const std::string& problem() const { return problem_; }
  /// "volume" and measured profiles are not sums of this sort.
  static bool judges(const RenderSettings& settings);

 private:
  RendererOptions options_;
  std::unique_ptr<Renderer> renderer_;
  BackgroundDipole dipole_;
  std::string key_, problem_;
  std::optional<Image> sampled_;
  std::optional<Metrics> found_;
};

}  // namespace lychnite::viewer
