#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lychnite/mesh/mesh.h"

namespace lychnite {

/// Why the simple formats have readers of our own. assimp 5.2 repairs silently what must be refused (indices
/// past the vertices are clamped or dropped, a cut-off file is a smaller model), believes the counts of a
/// header before it looks at the file's size, and holds a mesh several times over. Each of these readers
/// checks every count against the bytes that are left before it allocates, and names the line, face or
/// element that is wrong.
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
Mesh readGltf(std::string_view bytes, const std::filesystem::path& path);

}  // namespace lychnite
