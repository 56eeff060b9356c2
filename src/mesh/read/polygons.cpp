#include "mesh/read/polygons.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <span>
#include <utility>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

constexpr size_t kMostClipped = 1024;     // corners of a face that is still clipped; erasing is quadratic
constexpr size_t kTestsPerCorner = 1024;  // bounds the cubic worst case of hostile faces

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Newell's normal: right for concave and slightly bent polygons.
glm::dvec3 newellNormal(const std::vector<glm::vec3>& positions, std::span<const uint32_t> face) {
  glm::dvec3 normal(0);
  const glm::dvec3 origin = positions[face[0]];
  for (size_t i = 0; i < face.size(); ++i)
    normal += glm::cross(glm::dvec3(positions[face[i]]) - origin,
                         glm::dvec3(positions[face[(i + 1) % face.size()]]) - origin);
  return normal;
}

class EarClipper {
 public:
  EarClipper(const std::vector<glm::vec3>& positions, std::span<const uint32_t> face)
      : ids_(face.begin(), face.end()), tests_left_(kTestsPerCorner * face.size()) {
    const glm::dvec3 normal = newellNormal(positions, face);
    const glm::dvec3 size = glm::abs(normal);
    const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    int u = (drop + 1) % 3, v = (drop + 2) % 3;
    if (normal[drop] < 0) std::swap(u, v);
    for (const uint32_t id : face) points_.emplace_back(positions[id][u], positions[id][v]);
  }

  void clip(std::vector<glm::uvec3>& triangles) {
    while (ids_.size() > 3) {
      // Starting at 1 makes a convex face a fan around its first corner, as everybody cuts it.
      size_t ear = 1;
      while (ear < ids_.size() && !isEar(ear)) ++ear;
      if (ear == ids_.size()) ear = 1;  // a degenerate face: any cut will do
      triangles.push_back({ids_[before(ear)], ids_[ear], ids_[after(ear)]});
      ids_.erase(ids_.begin() + static_cast<ptrdiff_t>(ear));
      points_.erase(points_.begin() + static_cast<ptrdiff_t>(ear));
    }
    triangles.push_back({ids_[0], ids_[1], ids_[2]});
  }

 private:
  size_t before(size_t i) const { return i == 0 ? ids_.size() - 1 : i - 1; }
  size_t after(size_t i) const { return i + 1 == ids_.size() ? 0 : i + 1; }
  double cornerTurn(size_t i) const { return turn(points_[before(i)], points_[i], points_[after(i)]); }

  bool isEar(size_t i) {
    if (!(cornerTurn(i) > 0)) return false;
    const glm::dvec2 &a = points_[before(i)], &b = points_[i], &c = points_[after(i)];
    for (size_t k = 0; k < points_.size(); ++k) {
      if (tests_left_ == 0) return true;
      --tests_left_;
      const glm::dvec2& p = points_[k];
      if (p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  std::vector<uint32_t> ids_;
  std::vector<glm::dvec2> points_;
  size_t tests_left_;
};

void cutFace(const std::vector<glm::vec3>& positions, std::span<const uint32_t> face,
             std::vector<glm::uvec3>& triangles) {
  if (face.size() == 3) {
    triangles.push_back({face[0], face[1], face[2]});
  } else if (face.size() <= kMostClipped) {
    EarClipper(positions, face).clip(triangles);
  } else {
    for (size_t i = 2; i < face.size(); ++i) triangles.push_back({face[0], face[i - 1], face[i]});
  }
}

}  // namespace

Mesh triangulate(Polygons polygons, const std::string& where) {
  Mesh mesh;
  mesh.positions = std::move(polygons.positions);
  mesh.normals = std::move(polygons.normals);
  size_t count = 0;
  for (const uint32_t size : polygons.sizes) count += size < 3 ? 0 : size - 2;
  mesh.triangles.reserve(count);
  size_t begin = 0;
  for (size_t f = 0; f < polygons.sizes.size(); ++f) {
    const std::span<const uint32_t> face(polygons.corners.data() + begin, polygons.sizes[f]);
    begin += face.size();
    for (const uint32_t corner : face)
      if (corner >= mesh.positions.size())
        throw Error({.where = where,
                     .expected = "corners below the vertex count of " + std::to_string(mesh.positions.size()),
                     .found = "index " + std::to_string(corner) + " in face " + std::to_string(f),
                     .todo = "export the model again"});
    if (face.size() >= 3) cutFace(mesh.positions, face, mesh.triangles);
  }
  return mesh;
}

}  // namespace lychnite
