#pragma once

#include <optional>

#include "gpu/framebuffer.h"
#include "gpu/pass.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "technique/key.h"
#include "technique/mesh_cache.h"

namespace lychnite {

/// The camera's view of the surface: 2 x 2 samples a pixel, each (depth along the axis in scene units,
/// octahedral normal, object number from 1; 0 where there is nothing).
class GeometryPass {
 public:
  GeometryPass();
  /// Draws when camera, objects or resolution changed; tells whether it did.
  bool update(const Frame& frame, const MeshCache& meshes);
  const gpu::Texture& samples() const { return targets_->samples; }
  const Key& key() const { return key_; }

 private:
  struct Targets {
    gpu::Texture samples, depth;
    gpu::Framebuffer framebuffer;
  };
  void resize(int width, int height);

  gpu::Program program_;
  std::optional<Targets> targets_;
  Key key_;
};

/// What every shading pass needs to find its receivers (shaders/pass/receiver.glsl).
void setReceiverUniforms(gpu::Program& program, const Frame& frame, const gpu::Texture& samples,
                         size_t object);

/// The rectangle of pixels that the object's bounding sphere can cover; empty when it is behind the camera or
/// outside.
gpu::Rect screenBounds(const Frame& frame, const FrameObject& object);

}  // namespace lychnite
