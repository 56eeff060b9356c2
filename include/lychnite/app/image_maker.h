#pragma once

#include <memory>

#include "lychnite/app/profile_store.h"
#include "lychnite/base/progress.h"
#include "lychnite/image/image.h"
#include "lychnite/reference/reference.h"
#include "lychnite/scene/scene.h"
#include "lychnite/scene/settings.h"
#include "lychnite/technique/renderer.h"
#include "lychnite/volume/volume.h"

namespace lychnite {

/// Any method, one call: the real-time methods through one Renderer that is made when first needed and kept,
/// the judges through renderReference(). Pictures carry what made them (scene, settings, version) as
/// metadata. Profiles come from a ProfileStore on the user's cache folder, unless `options` brings a maker of
/// its own.
class ImageMaker {
 public:
  explicit ImageMaker(RendererOptions options);

  /// Throws what Renderer::render, VolumeSolver::render and renderReference throw. `volume` keeps its solver
  /// too; scenes in which an object has no inside are rendered by `matched`, with a warning and metadata
  /// "fallback". `reference` is read by the judges only.
  Image render(const Scene& scene, const RenderSettings& settings, const Progress& progress = {},
               const ReferenceOptions& reference = {});
  /// Of the last real-time picture; nothing after a judge's.
  const RenderStats* stats() const { return lastWasRealTime_ ? &renderer_->stats() : nullptr; }

 private:
  Image renderRealTime(const Scene& scene, const RenderSettings& settings, const Progress& progress);
  Image renderVolume(const Scene& scene, const RenderSettings& settings, const Progress& progress);

  std::unique_ptr<ProfileStore> store_;
  RendererOptions options_;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<VolumeSolver> volume_;
  bool lastWasRealTime_ = false;
};

/// The program's version, "0.1.0".
const char* versionText();

}  // namespace lychnite
