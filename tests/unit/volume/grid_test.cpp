#include "volume/grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <queue>

#include "lychnite/mesh/builtin.h"
#include "lychnite/mesh/load.h"
#include "volume/smooth.h"
#include "volume/surface.h"

namespace lychnite::volume {
namespace {

/// Boxes, each from a corner to a corner, as one mesh.
Mesh boxes(const std::vector<std::pair<glm::vec3, glm::vec3>>& corners, bool open = false) {
  Mesh mesh;
  for (const auto& [low, high] : corners) {
    const auto first = uint32_t(mesh.positions.size());
    for (int i = 0; i < 8; ++i)
      mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    const uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (int f = open ? 1 : 0; f < 6; ++f) {
      mesh.triangles.push_back({first + faces[f][0], first + faces[f][1], first + faces[f][2]});
      mesh.triangles.push_back({first + faces[f][0], first + faces[f][2], first + faces[f][3]});
    }
  }
  mesh.normals = angleWeightedNormals(mesh.positions, mesh.triangles);
  return mesh;
}

double volumeOf(const Grid& grid) {
  double sum = 0;
  for (size_t i = 0; i < grid.size(); ++i) sum += double(grid.cell(i).volume);
  return sum;
}

/// How many cells can be reached from cell 0.
size_t reached(const Grid& grid) {
  std::vector<bool> seen(grid.size());
  std::queue<uint32_t> next;
  next.push(0);
  seen[0] = true;
  size_t count = 0;
  for (; !next.empty(); next.pop(), ++count)
    for (auto* link = grid.linksBegin(next.front()); link != grid.linksEnd(next.front()); ++link)
      if (!seen[link->to]) seen[link->to] = true, next.push(link->to);
  return count;
}

TEST(Grid, VolumeAndAreaOfASphereConverge) {
  const LocalMesh sphere(*builtinMesh("sphere"));
  for (const int cells : {8, 16, 32, 64}) {
    const Grid grid(sphere, cells);
    const Surface surface(sphere, grid);
    EXPECT_NEAR(volumeOf(grid), 3.14159265 / 6, 1e-3) << cells;  // the mesh's facets cost 2e-4
    EXPECT_NEAR(surface.area(), 3.14159265, 1e-3) << cells;
    double flux = 0;  // of the field p through the surface: three times the volume
    for (const auto& s : surface.samples()) flux += double(s.area * glm::dot(s.normal, s.position));
    EXPECT_NEAR(flux, 3.14159265 / 2, 2e-3) << cells;
    EXPECT_EQ(reached(grid), grid.size());
  }
}

TEST(Grid, CellsAreNotSmallAndLinksGoBothWays) {
  const LocalMesh knot(*builtinMesh("knot"));
  const Grid grid(knot, 48);
  const double voxel = std::pow(grid.side(), 3);
  for (size_t i = 0; i < grid.size(); ++i) {
    EXPECT_GE(double(grid.cell(i).volume), 0.25 * voxel);
    for (auto* link = grid.linksBegin(i); link != grid.linksEnd(i); ++link) {
      EXPECT_NE(link->to, i);
      double back = 0;
      for (auto* other = grid.linksBegin(link->to); other != grid.linksEnd(link->to); ++other)
        if (other->to == i) back += double(other->conductance);
      EXPECT_NEAR(back, double(link->conductance), 1e-6);
    }
  }
}

TEST(Grid, EveryPointInsideHasACell) {
  const LocalMesh sphere(*builtinMesh("sphere"));
  const Grid grid(sphere, 32);
  for (int i = 0; i < 1000; ++i) {
    const float r = 0.49f * std::cbrt(float(i) / 1000), t = 2.4f * float(i), z = std::cos(0.7f * float(i));
    const glm::vec3 p =
        r * glm::vec3(std::sqrt(1 - z * z) * std::cos(t), std::sqrt(1 - z * z) * std::sin(t), z);
    const uint32_t cell = grid.find(p);
    ASSERT_NE(cell, Grid::kNone);
    EXPECT_LT(glm::distance(grid.cell(cell).centroid, p), 2 * grid.side());
  }
  EXPECT_EQ(grid.find({0.4f, 0.4f, 0.4f}), Grid::kNone);
}

TEST(Grid, AGapNarrowerThanACellKeepsBothSidesApart) {
  // Slabs of 3 voxels with a gap of a twentieth, in all three directions of the lines and across them.
  for (int axis = 0; axis < 3; ++axis) {
    const auto turned = [&](float x, float y, float z) {
      glm::vec3 p;
      p[axis] = x;
      p[(axis + 1) % 3] = y;
      p[(axis + 2) % 3] = z;
      return p;
    };
    const Mesh mesh =
        boxes({{turned(0, 0, 0), turned(0.2f, 1, 0.5f)}, {turned(0.203f, 0, 0), turned(0.4f, 1, 0.5f)}});
    const Grid grid(LocalMesh(mesh), 16);
    EXPECT_NEAR(double(reached(grid)) / double(grid.size()), 0.5, 0.1) << axis;
  }
  const Mesh joined = boxes({{{0, 0, 0}, {0.201f, 1, 0.5f}}, {{0.2f, 0, 0}, {0.4f, 1, 0.5f}}});
  const Grid grid(LocalMesh(joined), 16);
  EXPECT_EQ(reached(grid), grid.size());
  EXPECT_NEAR(volumeOf(grid), 0.2, 1e-3);
}

TEST(Columns, TellWhetherInsideIsDefined) {
  EXPECT_EQ(undefinedInside(LocalMesh(*builtinMesh("stone"))), 0);
  const Mesh overlapping = boxes({{{0, 0, 0}, {0.6f, 1, 1}}, {{0.4f, 0, 0}, {1, 1, 1}}});
  EXPECT_EQ(undefinedInside(LocalMesh(overlapping)), 0);
  EXPECT_GT(undefinedInside(LocalMesh(boxes({{{0, 0, 0}, {1, 1, 1}}}, true))), 0.5);
  Mesh inverted = boxes({{{0, 0, 0}, {1, 1, 1}}});
  for (glm::uvec3& t : inverted.triangles) std::swap(t.y, t.z);
  EXPECT_GT(undefinedInside(LocalMesh(inverted)), 0.5);
}

TEST(Smoother, ConservesFluxAndKeepsAConstantRadiosity) {
  // A slab, for its edges.
  const LocalMesh slab(*builtinMesh("slab"));
  const Grid grid(slab, 24);
  const Surface surface(slab, grid);
  const Smoother smoother(grid, surface);
  std::vector<Lanes> constant, point(surface.nodes().size(), Lanes{0, 0, 0, 0});
  for (const auto& node : surface.nodes()) constant.push_back(Lanes{node.area, 2 * node.area, 0, 0});
  point[100] = Lanes{1, 0, 0, 0};
  const auto gaussian = smoother.filter([](double q, int) { return std::exp(-0.5 * 4 * q * q); });
  const auto out = smoother.filtered({{constant, {gaussian}}, {point, {gaussian}}});
  const auto &same = out[0][0], &spread = out[1][0];
  double sum = 0;
  for (size_t i = 0; i < same.size(); ++i) {
    EXPECT_NEAR(same[i][0], constant[i][0], 0.02f * constant[i][0]);
    sum += double(spread[i][0]);
  }
  EXPECT_NEAR(sum, 1, 0.02);
  EXPECT_LT(spread[100][0], 0.2f);
}

}  // namespace
}  // namespace lychnite::volume
