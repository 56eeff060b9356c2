#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "lychnite/base/error.h"
#include "lychnite/mesh/load.h"
#include "mesh/topology.h"

namespace lychnite {
namespace {

bool isFinite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string countOf(size_t count, const char* what) {
  return std::to_string(count) + " " + what;
}

void validate(const Mesh& mesh, const std::string& where) {
  constexpr size_t kMostVertices = UINT32_MAX;
  if (mesh.positions.size() >= kMostVertices)
    throw Error({.where = where,
                 .expected = "fewer than " + countOf(kMostVertices, "vertices"),
                 .found = countOf(mesh.positions.size(), ""),
                 .todo = "simplify the model"});
  for (size_t v = 0; v < mesh.positions.size(); ++v)
    if (!isFinite(mesh.positions[v]))
      throw Error(
          {.where = where,
           .expected = "finite coordinates",
           .found = "NaN, infinity or a number past the range of floats in vertex " + std::to_string(v),
           .todo = "export the model again"});
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& corners = mesh.triangles[t];
    const uint32_t largest = std::max({corners.x, corners.y, corners.z});
    if (largest >= mesh.positions.size())
      throw Error({.where = where,
                   .expected = "corners below the vertex count of " + std::to_string(mesh.positions.size()),
                   .found = "index " + std::to_string(largest) + " in triangle " + std::to_string(t),
                   .todo = "export the model again"});
  }
}

void refuseZeroExtent(const Mesh& mesh, const std::string& where) {
  if (mesh.triangles.empty())
    throw Error({.where = where,
                 .expected = "triangles",
                 .found = countOf(mesh.positions.size(), "vertices and no face"),
                 .todo = "points and lines cannot be rendered: export the model with its faces"});
  const glm::vec3& first = mesh.positions[mesh.triangles[0].x];
  for (const glm::uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      if (mesh.positions[t[i]] != first) return;
  throw Error({.where = where,
               .expected = "a mesh with an extent",
               .found = "all " + countOf(mesh.triangles.size(), "triangles in one point"),
               .todo = "export the model again"});
}

// A file's normals are kept whole or not at all: a model that is smooth here and made up there shows a seam.
bool normalsUsable(const Mesh& mesh) {
  if (mesh.normals.size() != mesh.positions.size()) return false;
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& t) {
    for (int i = 0; i < 3; ++i) {
      const glm::vec3& n = mesh.normals[t[i]];
      if (!isFinite(n) || !(glm::length(glm::dvec3(n)) > 0)) return false;
    }
    return true;
  });
}

void normalizeNormals(Mesh& mesh) {
  for (glm::vec3& n : mesh.normals) {
    const double length = glm::length(glm::dvec3(n));
    n = length > 0 && std::isfinite(length) ? glm::vec3(glm::dvec3(n) / length) : glm::vec3(0, 1, 0);
  }
}

void dropDegenerates(Mesh& mesh, RepairReport& report) {
  const auto last = std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& t) {
    return t.x == t.y || t.y == t.z || t.z == t.x || areaVector(mesh, t) == glm::dvec3(0);
  });
  report.degenerate_triangles = static_cast<size_t>(mesh.triangles.end() - last);
  mesh.triangles.erase(last, mesh.triangles.end());
}

// Moves the vertices that triangles use to the front, in the file's order, and forgets the others.
void dropUnused(Mesh& mesh) {
  std::vector<uint32_t> to(mesh.positions.size(), 0);
  for (const glm::uvec3& t : mesh.triangles) to[t.x] = to[t.y] = to[t.z] = 1;
  uint32_t kept = 0;
  for (size_t v = 0; v < to.size(); ++v) {
    if (!to[v]) continue;
    mesh.positions[kept] = mesh.positions[v];
    if (!mesh.normals.empty()) mesh.normals[kept] = mesh.normals[v];
    to[v] = kept++;
  }
  mesh.positions.resize(kept);
  if (!mesh.normals.empty()) mesh.normals.resize(kept);
  for (glm::uvec3& t : mesh.triangles) t = {to[t.x], to[t.y], to[t.z]};
  mesh.positions.shrink_to_fit();
  mesh.normals.shrink_to_fit();
  mesh.triangles.shrink_to_fit();
}

void weld(Mesh& mesh, RepairReport& report) {
  const std::vector<uint32_t> first = firstEquals(mesh.positions, mesh.normals);
  for (size_t v = 0; v < first.size(); ++v) report.duplicate_vertices += first[v] != v;
  for (glm::uvec3& t : mesh.triangles) t = {first[t.x], first[t.y], first[t.z]};
}

bool turnIfInsideOut(Mesh& mesh, const EdgeFacts& edges) {
  const Bounds bounds = boundsOf(mesh);
  const double side = bounds.longestSide();
  constexpr double kRounding = 1e-12;  // two sheets back to back enclose nothing, up to rounding
  if (signedVolume(mesh, bounds) >= -kRounding * side * side * side) return false;
  if (!edges.closed()) return false;
  for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  return true;
}

// The triangles say what is outside; a file whose normals mostly say the opposite has them all turned.
bool alignNormals(Mesh& mesh) {
  ptrdiff_t agreement = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 across = areaVector(mesh, t);
    for (int i = 0; i < 3; ++i) agreement += glm::dot(across, glm::dvec3(mesh.normals[t[i]])) < 0 ? -1 : 1;
  }
  if (agreement < 0)
    for (glm::vec3& n : mesh.normals) n = -n;
  return agreement < 0;
}

RepairReport repairInPlace(Mesh& mesh, const std::string& where) {
  RepairReport report;
  report.file_vertices = mesh.positions.size();
  report.file_triangles = mesh.triangles.size();
  validate(mesh, where);
  refuseZeroExtent(mesh, where);
  report.normals_made = !normalsUsable(mesh);
  if (report.normals_made) mesh.normals = {};
  normalizeNormals(mesh);
  weld(mesh, report);
  dropDegenerates(mesh, report);
  if (mesh.triangles.empty())
    throw Error({.where = where,
                 .expected = "triangles with an area",
                 .found = "all " + countOf(report.file_triangles, "triangles are degenerate"),
                 .todo = "export the model again"});
  dropUnused(mesh);
  report.unused_vertices = report.file_vertices - report.duplicate_vertices - mesh.positions.size();
  const EdgeFacts edges = edgeFacts(mesh.triangles, firstEquals(mesh.positions));
  report.boundary_edges = edges.boundary;
  report.flipped = turnIfInsideOut(mesh, edges);
  if (report.normals_made)
    mesh.normals = angleWeightedNormals(mesh.positions, mesh.triangles);
  else
    report.normals_turned = alignNormals(mesh);
  return report;
}

}  // namespace

LoadedMesh repairMesh(Mesh mesh, const std::string& where) {
  const auto start = std::chrono::steady_clock::now();
  LoadedMesh loaded;
  mesh.extent.reset();
  loaded.report = repairInPlace(mesh, where);
  mesh.extent = extentOf(mesh);
  loaded.mesh = std::make_shared<const Mesh>(std::move(mesh));
  loaded.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return loaded;
}

}  // namespace lychnite
