// The shapes with an exact description: sphere, slab and disc, the analytic tests' bodies.

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "mesh/builtin/models.h"
#include "mesh/builtin/portable_trig.h"
#include "mesh/builtin/surface.h"

namespace lychnite::builtin {
namespace {

Surface icosahedron() {
  const double g = 0.5 * (1 + std::sqrt(5.0));  // the golden ratio
  Surface s;
  s.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (glm::dvec3& p : s.positions) p = glm::normalize(p);
  s.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return s;
}

/// Each triangle becomes four, with the new corners pushed out to the unit sphere.
Surface subdividedOnSphere(Surface s) {
  std::map<std::pair<unsigned, unsigned>, unsigned> middles;
  const auto middle = [&](unsigned a, unsigned b) {
    const auto [it, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<unsigned>(s.positions.size()));
    if (is_new) s.positions.push_back(glm::normalize(s.positions[a] + s.positions[b]));
    return it->second;
  };
  std::vector<glm::uvec3> finer;
  finer.reserve(4 * s.triangles.size());
  for (const glm::uvec3& t : s.triangles) {
    const unsigned ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
    finer.insert(finer.end(), {{t.x, ab, ca}, {ab, t.y, bc}, {ca, bc, t.z}, {ab, bc, ca}});
  }
  s.triangles = std::move(finer);
  return s;
}

/// A rectangle's own grid of vertices, spanned by u and v about its centre; u x v points outwards.
struct Face {
  glm::dvec3 centre, u, v;
  int cells_u = 1, cells_v = 1;
};

void addFace(Surface& s, const Face& f) {
  const auto first = static_cast<unsigned>(s.positions.size());
  for (int j = 0; j <= f.cells_v; ++j)
    for (int i = 0; i <= f.cells_u; ++i)
      s.positions.push_back(f.centre + (double(i) / f.cells_u - 0.5) * f.u +
                            (double(j) / f.cells_v - 0.5) * f.v);
  const unsigned row = f.cells_u + 1;
  for (int j = 0; j < f.cells_v; ++j)
    for (int i = 0; i < f.cells_u; ++i) {
      const unsigned a = first + j * row + i;
      s.addQuad(a, a + 1, a + row + 1, a + row);
    }
}

}  // namespace

Mesh makeSphere() {
  Surface s = icosahedron();
  for (int level = 0; level < 5; ++level) s = subdividedOnSphere(std::move(s));
  return finishMesh(s);
}

Mesh makeSlab() {
  constexpr int kWide = 40, kThin = 4;
  constexpr double kThickness = 0.1;
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, kThickness);
  Surface s;
  // Every face has its own vertices, so that the edges stay sharp and the normals of a face are all its own.
  addFace(s, {0.5 * z, x, y, kWide, kWide});
  addFace(s, {-0.5 * z, y, x, kWide, kWide});
  addFace(s, {0.5 * x, y, z, kWide, kThin});
  addFace(s, {-0.5 * x, z, y, kThin, kWide});
  addFace(s, {0.5 * y, z, x, kThin, kWide});
  addFace(s, {-0.5 * y, x, z, kWide, kThin});
  return finishMesh(s);
}

Mesh makeDisc() {
  // Ring k has 8 k vertices, so that triangles are about equally large from the centre to the rim's 512
  // segments.
  constexpr unsigned kRings = 64, kSectors = 8;
  Surface s;
  s.positions.emplace_back(0);
  for (unsigned k = 1; k <= kRings; ++k)
    for (unsigned i = 0; i < kSectors * k; ++i) {
      const CirclePoint c = circlePoint(double(i) / (kSectors * k));
      const double r = 0.5 * k / kRings;
      s.positions.emplace_back(r * c.cos, r * c.sin, 0);
    }
  const auto vertex = [](unsigned ring, unsigned i) {
    return ring == 0 ? 0u : 1 + kSectors * ring * (ring - 1) / 2 + i % (kSectors * ring);
  };
  for (unsigned k = 1; k <= kRings; ++k)
    for (unsigned sector = 0; sector < kSectors; ++sector)
      for (unsigned i = 0; i < k; ++i) {
        const unsigned outer = sector * k + i, inner = sector * (k - 1) + i;
        s.triangles.emplace_back(vertex(k, outer), vertex(k, outer + 1), vertex(k - 1, inner));
        if (i + 1 < k)
          s.triangles.emplace_back(vertex(k, outer + 1), vertex(k - 1, inner + 1), vertex(k - 1, inner));
      }
  return finishMesh(s);
}

}  // namespace lychnite::builtin
