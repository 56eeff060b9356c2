#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lychnite/mesh/mesh.h"

namespace lychnite {

struct AnimationData;

/// The motion of a glTF file's meshes: skeletons, morph targets and moving nodes, evaluated for any moment
/// with nothing precomputed. Immutable; safe to use from several threads.
class MeshAnimation {
 public:
  struct Clip {
    std::string name;    ///< the file's, or "animation 2"; different for each clip
    double seconds = 0;  ///< of its last key
  };

  /// `rest` is the mesh that stands for no clip at all (the file's nodes, joints and weights as they are).
  MeshAnimation(AnimationData data, std::shared_ptr<const Mesh> rest);
  ~MeshAnimation();

  const std::vector<Clip>& clips() const;
  const std::shared_ptr<const Mesh>& rest() const { return rest_; }

  /// The mesh at a moment of a clip, from 0 to its seconds (others are clamped). Vertices and triangles are
  /// those of the file and the same at every moment. Its extent has the box of the mesh at rest, so that an
  /// object keeps its place and scale while it moves, and the radius about the box's centre that holds every
  /// moment of the clip. Throws Error for a moment at which a vertex has no finite place or one past a
  /// million sizes away; Error (Kind::kUsage) for a clip that is not there.
  std::shared_ptr<const Mesh> pose(size_t clip, double seconds) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  std::shared_ptr<const Mesh> rest_;
};

}  // namespace lychnite
