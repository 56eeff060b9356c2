#pragma once

#include "lychnite/base/log.h"
#include "lychnite/base/progress.h"
#include "lychnite/image/image.h"
#include "lychnite/scene/scene.h"
#include "lychnite/scene/settings.h"

namespace lychnite {

/// What only the judges read.
struct ReferenceOptions {
  /// A picture of the walk to go on from: same scene, resolution and settings (limits may differ), made with
  /// keepState. Its photons count towards settings.samples.
  const Image* resume = nullptr;
  /// Of the walk: adds the layers "state.*" and metadata that `resume` needs.
  bool keepState = false;
  ProfileMaker profiles;  ///< of dipole and hierarchical; empty: formulas only (lychnite/optics/profile.h)
};

/// Renders a scene on the CPU by settings.method (dipole, hierarchical or walk). Same picture conventions as
/// the real-time Renderer: 2 x 2 geometry samples a pixel at (.25, .75), colour over background, A =
/// coverage. All layers are means over the pixel. Throws Error; an interrupted walk returns what it has with
/// metadata "interrupted" = "true", the others throw Interrupted.
///
/// The walk traces settings.samples photons a pixel, or, where given, until settings.timeLimit or
/// settings.noise. Same settings and seed, same picture, whatever the threads. Layers of its own:
/// "radiosity", of all orders of scattering, and "stderr", the standard error of multiple and single
/// together, from independent batches. Metadata: photons, photons_per_pixel, batches, single_passes, seconds,
/// noise (root mean square of the standard error over the mean, covered pixels, RGB together), and shares of
/// the arriving power, per channel: escaped, absorbed, blocked (on opaque objects), ended (by Russian
/// roulette, net: 0 on average), lost (through holes of
/// meshes that are not closed; there inside is undefined, and a warning is logged).
Image renderReference(const Scene& scene, const RenderSettings& settings, const Progress& progress = {},
                      const LogSink& log = {}, const ReferenceOptions& options = {});

}  // namespace lychnite
