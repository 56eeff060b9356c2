#pragma once

#include <glm/mat4x4.hpp>
#include <optional>
#include <vector>

#include "mesh/animation_data.h"
#include "mesh/read/gltf_file.h"

namespace lychnite {

/// Vertices that one primitive of one node's mesh became.
struct GltfPart {
  size_t node = 0, mesh = 0, primitive = 0, first = 0, count = 0;
};

/// A node's own transform, by its matrix or its translation, rotation and scale.
glm::dmat4 gltfTransform(const nlohmann::json& node);

/// What can move of the vertices that were read; nothing for a file without skins, morph targets and
/// animations. `placed` has normals or none at all, and its triangles.
std::optional<AnimationData> readGltfAnimation(GltfFile& file, const std::vector<GltfPart>& parts,
                                               const Mesh& placed);

}  // namespace lychnite
