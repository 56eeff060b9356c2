#pragma once

#include "gpu/texture.h"
#include "lychnite/technique/renderer.h"
#include "technique/light_map/light_map_pass.h"

namespace lychnite {

/// What a Renderer's last draw() or render() left on the device, for windows that show it without reading it
/// back. Valid until the next call of that renderer.
struct RendererTextures {
  /// Linear radiance and coverage, row 0 lowest.
  static const gpu::Texture& picture(const Renderer& renderer);
  /// 2 x 2 samples a pixel: depth in scene units, octahedral normal, object number from 1.
  static const gpu::Texture& geometry(const Renderer& renderer);
  static const LightMapPass& maps(const Renderer& renderer);
};

}  // namespace lychnite
