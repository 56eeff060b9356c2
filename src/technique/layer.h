#pragma once

#include <functional>
#include <optional>
#include <string>

#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "technique/geometry/geometry_pass.h"
#include "technique/key.h"

namespace lychnite {

/// One component of one light, picture-sized RGB radiance, kept until something it depends on changes.
class Layer {
 public:
  /// Where an object's light goes.
  struct Target {
    const gpu::Framebuffer& framebuffer;
    const gpu::Texture& texture;  ///< its only colour
    gpu::Rect bounds;             ///< pixels the object can cover
  };
  /// Adds an object's light.
  using Shade = std::function<void(size_t object, const Target& target)>;
  /// Sets an object's uniforms and returns the program to shade it with, or nothing to leave it dark.
  using Prepare = std::function<gpu::Program*(size_t object)>;

  /// Clears and shades every object of the frame that can be seen unless `key` says that the same is there
  /// already; tells whether it drew.
  bool update(const std::string& label, const Key& key, const Frame& frame, const Shade& shade);
  /// The same with one program for each object, which writes a pixel's light.
  bool update(const std::string& label, const Key& key, const Frame& frame, const GeometryPass& geometry,
              const Prepare& prepare);
  const gpu::Texture& texture() const { return targets_->texture; }

 private:
  struct Targets {
    gpu::Texture texture;
    gpu::Framebuffer framebuffer;
  };
  std::optional<Targets> targets_;
  Key key_;
};

}  // namespace lychnite
