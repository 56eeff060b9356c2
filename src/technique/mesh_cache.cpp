#include "technique/mesh_cache.h"

#include <set>

namespace lychnite {

void MeshCache::update(const Frame& frame) {
  std::set<const Mesh*> used;
  for (const FrameObject& object : frame.objects) used.insert(object.source->mesh.get());
  std::erase_if(entries_, [&](const auto& entry) { return !used.contains(entry.first); });
  for (const FrameObject& object : frame.objects) {
    const std::shared_ptr<const Mesh>& mesh = object.source->mesh;
    if (entries_.contains(mesh.get())) continue;
    Entry entry{mesh, gpu::VertexArray("mesh " + object.source->model)};
    entry.vertices.setPositions(mesh->positions);
    entry.vertices.setNormals(mesh->normals);
    entry.vertices.setTriangles(mesh->triangles);
    entries_.emplace(mesh.get(), std::move(entry));
  }
}

}  // namespace lychnite
