#pragma once

#include <array>
#include <optional>

#include "gpu/buffer.h"
#include "technique/shading_inputs.h"

namespace lychnite {

/// Multiple scattering by the matched sampler, evaluated as thinly as the surface and its light are smooth:
/// in the middle of every 4 x 4 pixels, in blocks of 2 x 2 and in pixels where what is coarser cannot be
/// interpolated. What has to be evaluated is listed and computed side by side.
class MultipleMatchedShading {
 public:
  /// How often the samples of a slanted surface are doubled, at most, against one that faces the light.
  static constexpr int kMostRefinement = 2;
  /// Constants of pass/matched_sampler.glsl.
  static gpu::ShaderDefines defines();

  MultipleMatchedShading();
  bool update(Layer& layer, const ShadingInputs& in, size_t light);
  /// The uniforms of pass/matched_sampler.glsl and what its receivers need.
  void setUniforms(gpu::Program& program, const ShadingInputs& in, size_t object, size_t light);

 private:
  static constexpr int kLevels = 3;
  /// Sites at one distance from each other, see shaders/lists/matched_sites.glsl.
  struct Level {
    gpu::Texture value, surface;
    gpu::Framebuffer framebuffer;
    gpu::Buffer sites;   ///< the lists
    int listLength = 0;  ///< of each, at most
  };
  /// What is drawn: an object in one light.
  struct Target {
    const ShadingInputs& in;
    size_t object, light;
  };
  void resize(const CameraFrame& camera);
  void clear(int level);
  void plan(const Target& target, int level, const gpu::Rect& sites);
  void evaluate(const Target& target, int level, const gpu::Rect& sites);
  void setSiteUniforms(gpu::Program& program, const Target& target, int level);
  void shade(const Target& target, const Layer::Target& layer);

  gpu::Program plan_, evaluate_, gather_;
  std::array<std::optional<Level>, kLevels> levels_;  ///< shared by all objects and lights
  std::optional<gpu::Texture> evaluated_;             ///< of level 0, a row for each receiver of a pixel
};

}  // namespace lychnite
