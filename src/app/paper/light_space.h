#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "lychnite/image/image.h"
#include "lychnite/technique/renderer.h"

namespace lychnite::paper {

/// The flux of the light-space map of a scene's only object and light, as it is on the device: relative to
/// full entry, 0 where there is no surface. Row 0 is the lowest.
class FluxMap {
 public:
  /// Draws the scene with `renderer` by `matched`.
  FluxMap(Renderer& renderer, const Scene& scene, int size);

  int size() const { return size_; }
  double texel() const { return texel_; }  ///< mm
  /// Mean over the texel of a level (2^level texels wide) that holds a place, in texels of level 0.
  double mean(const glm::dvec2& place, int level) const;
  double total() const { return mean(glm::dvec2(0.5 * size_), 30) * size_ * size_; }
  /// White where nothing is lit, else grey by flux; the upper row first.
  Image picture() const;

 private:
  int size_;
  double texel_ = 1;
  std::vector<std::vector<float>> levels_;
};

/// A place that a method reads the map at, and what it stands for.
struct Sample {
  glm::dvec2 place{0};  ///< texels of level 0
  double level = 0;
  double area = 1;  ///< texels of level 0
};

/// A lit surface point, in texels of level 0 on the map, and the samples that a method takes for it.
struct Receiver {
  glm::dvec2 place{0};
  std::vector<Sample> samples;
};
/// Those of the pixels of a picture in which the scene is seen from its only, parallel, light: asked of the
/// method's own shader. `settings` give the method and how many pixels.
std::vector<Receiver> receiversOf(Renderer& renderer, Scene scene, RenderSettings settings);

/// What a pattern sees of the map.
struct Coverage {
  double area = 0;  ///< share of the lit texels that lie in a cell
  double flux = 0;  ///< flux that the cells stand for over the flux that enters
};
/// Cells as squares of their area.
Coverage coverageOf(const FluxMap& map, const std::vector<Sample>& samples);

}  // namespace lychnite::paper
