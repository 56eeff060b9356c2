#pragma once

#include <optional>

#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "technique/multiple/matched_shading.h"
#include "technique/renderer_textures.h"
#include "technique/shading.h"

namespace lychnite {

/// The samples that a method's own shader takes for a pixel, drawn into a row of texels and read back.
class SampleView {
 public:
  /// `sampler` is what the method shades with. Waits for the device.
  std::optional<SeenSamples> at(const ShadingInputs& in, MultipleMatchedShading& sampler,
                                const glm::ivec2& pixel, size_t light);
  std::optional<SeenSamples> at(const ShadingInputs& in, MultipleLatticeShading& sampler,
                                const glm::ivec2& pixel, size_t light);

 private:
  struct Row {
    gpu::Texture place, share;
    gpu::Framebuffer framebuffer;
  };
  /// Draws with a program whose sampler is set up.
  std::optional<SeenSamples> draw(gpu::Program& program, const ShadingInputs& in, int samples,
                                  const glm::ivec2& pixel, size_t object, size_t light);
  Row& row(int samples);

  std::optional<gpu::Program> matched_, adaptive_, fixed_;
  std::optional<Row> row_;
};

}  // namespace lychnite
