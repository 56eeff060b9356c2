#pragma once

#include "lychnite/base/progress.h"
#include "lychnite/image/image.h"
#include "lychnite/scene/settings.h"
#include "lychnite/volume/volume.h"
#include "volume/view.h"

namespace lychnite::volume {

/// Flux that leaves at the nodes of each body, times power over the square of the body's size: over the
/// nodes' areas it is radiosity. Without what leaves where it entered, in detail finer than nodes.
struct NodeLight {
  std::vector<std::vector<Lanes>> all, multiple;  ///< orders of scattering: all, two and up
  std::vector<glm::vec3> fineAll, fineMultiple;   ///< share of the flux that enters that is missing there
  std::vector<std::vector<Lanes>> error;          ///< standard error of `multiple`; empty where not known
};

/// As `view` sees it; `single` as SingleLight makes it, one entry a pixel, empty where it is not shown. A
/// preview looks for fine detail at one point of each pixel.
Image volumePicture(const RayScene& rays, const World& world, const NodeLight& light, View& view,
                    const std::vector<glm::vec3>& single, const RenderSettings& settings, bool preview,
                    const Progress& progress);

/// Adds what is known of the solution to the metadata, as volume.*.
void tellStats(const VolumeStats& stats, Image& image);

}  // namespace lychnite::volume
