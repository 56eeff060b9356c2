#pragma once

#include <optional>
#include <vector>

#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "technique/geometry/geometry_pass.h"

namespace lychnite {

/// Adds the layers to what shows of the background: linear radiance (rgb) and coverage (a).
class CompositePass {
 public:
  CompositePass();
  void draw(const Frame& frame, const GeometryPass& geometry, const Rgb& background,
            const std::vector<const gpu::Texture*>& layers);
  const gpu::Texture& picture() const { return targets_->picture; }

 private:
  struct Targets {
    gpu::Texture picture;
    gpu::Framebuffer framebuffer;
  };
  gpu::Program backgroundProgram_, addProgram_;
  std::optional<Targets> targets_;
};

}  // namespace lychnite
