#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lychnite/mesh/mesh.h"
#include "mesh/animation_data.h"

namespace lychnite {

/// Why these are readers of our own. assimp 5.2.5 was tried: it hands on indices past the vertices (PLY,
/// OFF), accepts a cut-off PLY, aborts the program on a cut-off OFF, and allocates for what a header claims
/// before it looks at the file's size. tinygltf 2.7.0, by its source, forgets a chunk's header when it checks
/// a GLB's length, so that it reads past the end, and copies the BIN chunk once for every buffer that the
/// file declares. Here every count is checked against the bytes that are left before anything is allocated
/// for it, and errors name the line, face or element that is wrong.
///
/// All of them: `bytes` is the whole file, `where` names it in errors; the mesh is as the file has it
/// (corners are below the vertex count, nothing else is checked), normals are empty or as many as positions.
Mesh readPly(std::string_view bytes, const std::string& where);
Mesh readObj(std::string_view bytes, const std::string& where);
Mesh readStl(std::string_view bytes, const std::string& where);
Mesh readOff(std::string_view bytes, const std::string& where);
Mesh read3ds(std::string_view bytes, const std::string& where);

/// glTF 2.0, text or binary by content; buffers beside the file are read relative to it. (tinygltf 2.7 reads
/// past the end of a cut-off BIN chunk and copies that chunk for every buffer that a file declares.)
struct GltfModel {
  Mesh mesh;                               ///< at rest: nodes, joints and weights as the file has them
  std::optional<AnimationData> animation;  ///< for files with skins, morph targets or clips
};
GltfModel readGltf(std::string_view bytes, const std::filesystem::path& path);

}  // namespace lychnite
