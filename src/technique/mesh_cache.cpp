#include "technique/mesh_cache.h"

#include <set>

namespace lychnite {

void MeshCache::update(Frame& frame) {
  std::set<const Mesh*> used;
  for (const FrameObject& object : frame.objects) used.insert(object.source->mesh.get());
  std::erase_if(entries_, [&](const auto& entry) { return !used.contains(entry.first); });
  for (FrameObject& object : frame.objects) {
    const std::shared_ptr<const Mesh>& mesh = object.source->mesh;
    auto found = entries_.find(mesh.get());
    if (found == entries_.end()) {
      Entry entry{mesh, gpu::VertexArray("mesh " + object.source->model), ++last_};
      entry.vertices.setPositions(mesh->positions);
      entry.vertices.setNormals(mesh->normals);
      entry.vertices.setTriangles(mesh->triangles);
      found = entries_.emplace(mesh.get(), std::move(entry)).first;
    }
    object.mesh = found->second.number;
  }
}

}  // namespace lychnite
