#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "lychnite/image/image.h"
#include "lychnite/scene/settings.h"
#include "reference/ray_scene.h"

namespace lychnite {

/// A surface point that the camera sees, standing for a part of one pixel. Scene units.
struct Receiver {
  uint32_t pixel = 0;   ///< row * width + column, top row first
  float weight = 1;     ///< share of the pixel's area: 1, or 1/4 for one of the 2 x 2 samples
  RayHit hit;           ///< on any object, translucent or opaque
  glm::vec3 normal{0};  ///< interpolated unit normal, turned to the camera's side where interpolation fails
  glm::vec3 view{0};    ///< unit, from the surface towards the camera
  float depth = 0;      ///< along the camera's forward direction
};

/// Receivers of a picture, in pixel order, and its coverage.
struct CameraReceivers {
  int width = 0, height = 0;
  std::vector<Receiver> receivers;
  std::vector<uint8_t> covered;  ///< of each pixel's 2 x 2 geometry samples, 0..4

  float alpha(size_t pixel) const { return 0.25f * covered[pixel]; }
};

/// Traces the 2 x 2 geometry samples of each pixel, at offsets .25 and .75. Where all four meet the same
/// object at similar depth and normal, one receiver at the pixel's centre stands for the pixel; else each
/// sample that meets something is one, of weight 1/4. Runs on the calling TBB arena.
CameraReceivers findReceivers(const RayScene& scene, int width, int height);

/// Adds "A" and, where asked for, the AOVs depth ("depth.Z", mm along the view axis, 0 where nothing is) and
/// normal
/// ("normal.X|Y|Z", interpolated, world axes), averaged over the covered part of each pixel.
void addGeometryLayers(Image& image, const CameraReceivers& receivers, const RayScene& scene,
                       const RenderSettings& settings);

}  // namespace lychnite
