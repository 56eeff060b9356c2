#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "lychnite/base/log.h"
#include "lychnite/mesh/animation.h"
#include "lychnite/mesh/mesh.h"

namespace lychnite {

/// What loading changed. file_vertices = the mesh's + duplicate + unused, file_triangles = the mesh's +
/// degenerate.
struct RepairReport {
  /// As the file's faces use them: polygons are cut into triangles, each STL corner is a vertex, and so is
  /// each pair of position and normal of an OBJ.
  size_t file_vertices = 0, file_triangles = 0;
  /// Welded: the same position and, where the file has normals, the same normal (so creases stay). -0 equals
  /// 0.
  size_t duplicate_vertices = 0;
  size_t degenerate_triangles = 0;  ///< dropped: two equal corners or no area
  size_t unused_vertices = 0;       ///< dropped
  bool normals_made = false;        ///< the file had none (or unusable ones)
  bool normals_turned = false;      ///< they pointed to the triangles' other side
  size_t boundary_edges = 0;        ///< of what is left; above 0 the surface has holes and no inside
  bool flipped = false;             ///< a closed mesh that was inside out was turned
};

struct LoadedMesh {
  std::shared_ptr<const Mesh> mesh;
  RepairReport report;
  std::shared_ptr<const MeshAnimation> animation;  ///< of a glTF file with animations, else null
  double seconds = 0;
};

/// Loads and repairs PLY, OBJ, STL, OFF, 3DS, glTF or GLB (by extension, case ignored); all meshes of a file
/// with their node transforms become one. Throws Error for a missing, unreadable, empty, truncated or
/// malformed file, NaN or infinite coordinates, indices past the vertices, no triangle left, an extent of
/// zero, or a required glTF extension that changes the geometry (mesh compression). Never allocates more than
/// a small multiple of the file's size; only copies of a glTF's meshes under many nodes may add up to 16
/// million triangles. The file's normals are kept when every vertex in use has one, and turned together where
/// they mostly oppose the triangles. Skins and morph
/// targets stand as the file's nodes and weights have them. Safe to call from several threads.
LoadedMesh loadMesh(const std::filesystem::path& path, const LogSink& log = {});

/// Welds, drops and makes normals as loadMesh does, on triangles from anywhere. `where` names them in errors.
LoadedMesh repairMesh(Mesh mesh, const std::string& where);

/// Facts about a mesh, for `lychnite info` and the methods' warnings.
struct MeshInfo {
  size_t vertices = 0, triangles = 0, components = 0;
  size_t boundary_edges = 0;      ///< edges of one triangle
  size_t non_manifold_edges = 0;  ///< edges of more than two
  bool closed = false;            ///< every edge has exactly two triangles, in opposite directions
  Bounds bounds;
  double area = 0;    ///< in mesh units squared
  double volume = 0;  ///< signed, in mesh units cubed; meaningful when closed
  size_t memory_bytes = 0;
};
/// Edges are matched by position, so that seams of split normals do not count as holes.
MeshInfo inspect(const Mesh& mesh);

}  // namespace lychnite
