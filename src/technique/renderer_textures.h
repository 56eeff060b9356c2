#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "gpu/texture.h"
#include "lychnite/technique/renderer.h"
#include "technique/light_map/light_map_pass.h"

namespace lychnite {

/// One sample of multiple scattering as a method's shader takes it.
struct SeenSample {
  glm::dvec2 uv{0};        ///< on the light-space map, v upwards
  double level = 0;        ///< mip level that it reads
  double width = 0;        ///< of its footprint, as share of the map's width
  Rgb radiosity{0};        ///< what it adds to the receiver's
  double depth = 0;        ///< of the lit surface there, scene units from the map's origin
  glm::dvec3 position{0};  ///< of the same, mm
  double side = 0;         ///< of its footprint there, across the light, mm
};

/// Those of one pixel and light. What they do not add up to, the matched sampler adds itself: the receiver's
/// own texel and the flux that no sample met.
struct SeenSamples {
  size_t object = 0;
  int receivers = 0;         ///< surface points that the pixel is shaded at, 1 to 4; this is the first
  glm::dvec3 receiver{0};    ///< mm
  glm::dvec2 receiverUv{0};  ///< on the light-space map
  Rgb radiosity{0};          ///< of the receiver, all of it
  std::vector<SeenSample> samples;
};

/// What a Renderer's last draw() or render() left on the device, for windows that show it without reading it
/// back. Valid until the next call of that renderer.
struct RendererTextures {
  /// Linear radiance and coverage, row 0 lowest.
  static const gpu::Texture& picture(const Renderer& renderer);
  /// 2 x 2 samples a pixel: depth in scene units, octahedral normal, object number from 1.
  static const gpu::Texture& geometry(const Renderer& renderer);
  static const LightMapPass& maps(const Renderer& renderer);
  /// The samples of a pixel ((0, 0) the lower left one) of the last draw(), which was of this scene and these
  /// settings; nothing where no translucent object is. Waits for the device.
  static std::optional<SeenSamples> samplesAt(Renderer& renderer, const Scene& scene,
                                              const RenderSettings& settings, const glm::ivec2& pixel,
                                              size_t light);
};

}  // namespace lychnite
