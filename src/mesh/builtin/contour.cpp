#include "mesh/builtin/contour.h"

#include <array>
#include <cassert>
#include <cmath>
#include <glm/vector_relational.hpp>
#include <utility>

namespace lychnite::builtin {
namespace {

constexpr unsigned kNone = ~0u;
constexpr int kBlock = 4;  ///< lattice points a side of the blocks that are skipped or sampled whole

/// Cube corner c lies at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge 4 a + i runs along axis a.
struct CubeEdge {
  int low, axis;   ///< its corner of smaller coordinates, and direction
  unsigned faces;  ///< bit set of the two faces it lies on
};

constexpr int edgeOf(int c0, int c1) {
  const int axis = (c0 ^ c1) == 1 ? 0 : (c0 ^ c1) == 2 ? 1 : 2;
  const int low = c0 & c1;
  const int rest = axis == 0 ? low >> 1 : axis == 1 ? (low & 1) | (low >> 1 & 2) : low & 3;
  return 4 * axis + rest;
}

/// The four corners of each face, counter-clockwise as seen from outside the cube.
constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                              {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

constexpr std::array<CubeEdge, 12> makeEdges() {
  std::array<CubeEdge, 12> edges{};
  for (int f = 0; f < 6; ++f)
    for (int i = 0; i < 4; ++i) {
      const int c0 = kFaces[f][i], c1 = kFaces[f][(i + 1) % 4];
      CubeEdge& e = edges[edgeOf(c0, c1)];
      e.low = c0 & c1;
      e.axis = edgeOf(c0, c1) / 4;
      e.faces |= 1u << f;
    }
  return edges;
}
constexpr std::array<CubeEdge, 12> kEdges = makeEdges();

/// For each crossed edge of a cell the next one around its polygon, else -1. On a face with four crossings
/// the two inside corners are kept apart, which both cells of the face see alike.
std::array<int, 12> tracePolygons(unsigned inside) {
  std::array<int, 12> next;
  next.fill(-1);
  const auto in = [&](int corner) { return (inside >> corner & 1) != 0; };
  for (const auto& face : kFaces)
    for (int i = 0; i < 4; ++i) {
      if (in(face[i]) || !in(face[(i + 1) % 4])) continue;
      int j = i + 1;  // the inside run starts at i + 1; find where it ends
      while (in(face[(j + 1) % 4])) ++j;
      next[edgeOf(face[i], face[(i + 1) % 4])] = edgeOf(face[j % 4], face[(j + 1) % 4]);
    }
  return next;
}

class Contourer {
 public:
  Contourer(const Field& field, const Bounds& bounds, double cell)
      : field_(field), origin_(bounds.min), cell_(cell) {
    size_ = glm::ivec3(glm::ceil(bounds.extent() / (cell * kBlock))) * kBlock;
    values_.resize(size_t(size_.x) * size_.y * size_.z);
    vertices_.resize(3 * values_.size(), kNone);
  }

  Surface run() {
    for (int z = 0; z < size_.z; z += kBlock)
      for (int y = 0; y < size_.y; y += kBlock)
        for (int x = 0; x < size_.x; x += kBlock) sampleBlock({x, y, z});
    for (const glm::ivec3& block : near_)
      forBlock(block, [&](const glm::ivec3& at) {
        if (glm::all(glm::lessThan(at + 1, size_))) contourCell(at);
      });
    return std::move(surface_);
  }

 private:
  template <class Visit>
  static void forBlock(const glm::ivec3& block, Visit visit) {
    for (int z = 0; z < kBlock; ++z)
      for (int y = 0; y < kBlock; ++y)
        for (int x = 0; x < kBlock; ++x) visit(block + glm::ivec3(x, y, z));
  }

  size_t index(const glm::ivec3& at) const { return (size_t(at.z) * size_.y + at.y) * size_.x + at.x; }
  glm::dvec3 place(const glm::dvec3& at) const { return origin_ + cell_ * at; }

  void sampleBlock(const glm::ivec3& block) {
    const double centre = field_(place(glm::dvec3(block) + 0.5 * (kBlock - 1)));
    // Every point of the block, and every cell that touches one, must be clear of the surface.
    const double reach = std::sqrt(3.0) * (0.5 * (kBlock - 1) + 1) * cell_;
    const bool near = std::abs(centre) < kMaxSlope * reach;
    if (near) near_.push_back(block);
    forBlock(block, [&](const glm::ivec3& at) {
      values_[index(at)] = near ? field_(place(glm::dvec3(at))) : centre;
    });
  }

  void contourCell(const glm::ivec3& at) {
    unsigned inside = 0;
    for (int c = 0; c < 8; ++c)
      if (values_[index(at + corner(c))] < 0) inside |= 1u << c;
    if (inside == 0 || inside == 0xff) return;
    std::array<int, 12> next = tracePolygons(inside);
    for (int e = 0; e < 12; ++e) {
      int polygon[12], count = 0;
      for (int at_edge = e; next[at_edge] >= 0;) {
        polygon[count++] = at_edge;
        at_edge = std::exchange(next[at_edge], -1);
      }
      if (count > 0) addPolygon(at, {polygon, size_t(count)});
    }
  }

  static glm::ivec3 corner(int c) { return {c & 1, c >> 1 & 1, c >> 2 & 1}; }

  /// A fan from a corner all of whose diagonals run through the cell's inside (one in a face could meet its
  /// like from the cell next door and join four triangles on an edge); from a new middle where no corner will
  /// do.
  void addPolygon(const glm::ivec3& at, std::span<const int> polygon) {
    const size_t n = polygon.size();
    for (size_t pivot = 0; pivot < n; ++pivot) {
      bool clear = true;
      for (size_t k = 2; k + 1 < n; ++k)
        clear = clear && !(kEdges[polygon[pivot]].faces & kEdges[polygon[(pivot + k) % n]].faces);
      if (!clear) continue;
      for (size_t k = 1; k + 1 < n; ++k)
        addTriangle({vertex(at, polygon[pivot]), vertex(at, polygon[(pivot + k) % n]),
                     vertex(at, polygon[(pivot + k + 1) % n])});
      return;
    }
    glm::dvec3 middle(0);
    for (int e : polygon) middle += surface_.positions[vertex(at, e)] / double(n);
    const auto m = static_cast<unsigned>(surface_.positions.size());
    surface_.positions.push_back(middle);
    for (size_t k = 0; k < n; ++k) addTriangle({m, vertex(at, polygon[k]), vertex(at, polygon[(k + 1) % n])});
  }

  /// Takes braces, which make the vertices in one order with every compiler.
  void addTriangle(const glm::uvec3& t) { surface_.triangles.push_back(t); }

  unsigned vertex(const glm::ivec3& at, int edge) {
    const glm::ivec3 low = at + corner(kEdges[edge].low);
    unsigned& id = vertices_[3 * index(low) + kEdges[edge].axis];
    if (id != kNone) return id;
    glm::ivec3 high = low;
    ++high[kEdges[edge].axis];
    const double a = values_[index(low)], b = values_[index(high)];
    // Kept off the lattice points, where vertices of several edges would fall together.
    const double t = glm::clamp(a / (a - b), 0.02, 0.98);
    id = static_cast<unsigned>(surface_.positions.size());
    surface_.positions.push_back(place(glm::mix(glm::dvec3(low), glm::dvec3(high), t)));
    return id;
  }

  const Field& field_;
  glm::dvec3 origin_;
  double cell_;
  glm::ivec3 size_;
  std::vector<double> values_;
  std::vector<unsigned> vertices_;
  std::vector<glm::ivec3> near_;
  Surface surface_;
};

}  // namespace

Surface contour(const Field& field, const Bounds& bounds, double cell) {
  assert(cell > 0);
  return Contourer(field, bounds, cell).run();
}

}  // namespace lychnite::builtin
