#pragma once

#include <map>
#include <memory>

#include "gpu/vertex_array.h"
#include "lychnite/mesh/mesh.h"
#include "technique/frame.h"

namespace lychnite {

/// The scene's meshes on the device, by identity: a mesh is immutable, so the same pointer needs no second
/// upload.
class MeshCache {
 public:
  /// Uploads what is new, lets go of what the frame no longer uses, and numbers the frame's meshes for the caches' keys
  /// (an address can be used again for another mesh).
  void update(Frame& frame);
  const gpu::VertexArray& get(const FrameObject& object) const {
    return entries_.at(object.source->mesh.get()).vertices;
  }

 private:
  struct Entry {
    std::shared_ptr<const Mesh> mesh;  // keeps the address from being used again
    gpu::VertexArray vertices;
    uint64_t number;
  };
  std::map<const Mesh*, Entry> entries_;
  uint64_t last_ = 0;
};

}  // namespace lychnite
