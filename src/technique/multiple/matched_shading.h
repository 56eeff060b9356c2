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
  /// Receivers to be evaluated, see shaders/lists/matched_sites.glsl.
  struct Lists {
    gpu::Buffer sites;
    int length = 0;  ///< of each, at most
  };
  /// Blocks of pixels.
  struct Level {
    gpu::Texture value, surface;
    gpu::Framebuffer framebuffer;
    Lists lists;
  };
  /// The pixels themselves. What they interpolate goes into the picture at once.
  struct Pixels {
    gpu::Texture listed;     ///< bits of the receivers that are evaluated
    gpu::Texture evaluated;  ///< a row for each receiver of a pixel; of as many rows as are shaded at once
    Lists lists;
  };
  /// What is drawn: an object in one light.
  struct Target {
    const ShadingInputs& in;
    size_t object, light;
  };
  void resize(const CameraFrame& camera);
  Level& blocks(int level) { return *levels_[size_t(level) - 1]; }
  Lists& listsOf(int level) { return level > 0 ? blocks(level).lists : pixels_->lists; }
  /// Lists the receivers of the sites that have to be evaluated and draws what the others interpolate.
  void plan(const Target& target, int level, const gpu::Framebuffer& framebuffer, const gpu::Rect& sites);
  /// Evaluates those listed; the sites' first row is `firstRow`.
  void evaluate(const Target& target, int level, int firstRow);
  void setSiteUniforms(gpu::Program& program, const Target& target, int level);
  void shadeBlocks(const Target& target, int level, const gpu::Rect& pixels);
  void shade(const Target& target, const Layer::Target& layer);

  gpu::Program plan_, evaluate_, gather_;
  // Shared by all objects and lights.
  std::array<std::optional<Level>, kLevels - 1> levels_;  ///< of 2 x 2 pixels, of 4 x 4
  std::optional<Pixels> pixels_;
};

}  // namespace lychnite
