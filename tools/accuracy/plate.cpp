#include "plate.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lychnite/mesh/load.h"

namespace lychnite::accuracy {

std::shared_ptr<const Mesh> roundedPlate() {
  constexpr int n = 64;
  const glm::vec3 half(0.06f, 0.5f, 0.35f);
  constexpr float radius = 0.04f;
  // Lines of the raster crowd in the edges.
  const auto line = [](int i, float extent) {
    const float t = 2 * float(i) / n - 1, edge = 0.375f, flat = extent - radius;
    const float a = std::abs(t),
                b = a < 1 - edge ? a / (1 - edge) * flat : flat + (a - 1 + edge) / edge * radius;
    return std::copysign(b, t);
  };
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      const auto first = uint32_t(mesh.positions.size());
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
          glm::vec3 q;
          q[axis] = side * half[axis];
          q[u] = line(i, half[u]);
          q[v] = line(j, half[v]);
          const glm::vec3 inner = glm::clamp(q, radius - half, half - radius);
          mesh.positions.push_back(inner + radius * glm::normalize(q - inner));
        }
      for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
          const uint32_t a = first + j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
          if (side > 0)
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
          else
            mesh.triangles.insert(mesh.triangles.end(), {{a, d, b}, {a, c, d}});
        }
    }
  return repairMesh(std::move(mesh), "plate").mesh;
}

}  // namespace lychnite::accuracy
