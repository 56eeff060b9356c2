#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "lychnite/image/image.h"
#include "lychnite/scene/settings.h"
#include "reference/camera_receivers.h"

namespace lychnite {

/// Radiance of a picture's parts, one entry a pixel, means over the whole pixel (so already weighted by
/// coverage). Parts that were not made are empty.
struct PictureParts {
  std::vector<glm::vec3> multiple, single, surface;
};

/// Colour over the background, coverage, and the layers of settings.aovs that come from the parts and the
/// geometry.
Image assemblePicture(const RayScene& rays, const CameraReceivers& receivers, const RenderSettings& settings,
                      const PictureParts& parts);

/// The surface part: every light, with traced shadows, and the surrounding. Runs on the calling TBB arena.
std::vector<glm::vec3> surfacePart(const RayScene& rays, const CameraReceivers& receivers);

/// Writes one value a pixel as the layer `name`.
void addLayer(Image& image, const std::string& name, const std::vector<glm::vec3>& values);

}  // namespace lychnite
