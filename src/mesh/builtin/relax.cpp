#include "mesh/builtin/relax.h"

#include <algorithm>
#include <array>
#include <unordered_set>

#include "mesh/builtin/contour.h"
#include "mesh/builtin/reduce.h"

namespace lychnite::builtin {
namespace {

uint64_t edgeKey(unsigned a, unsigned b) {
  return uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}

glm::dvec3 areaNormal(const Surface& s, const glm::uvec3& t) {
  return glm::cross(s.positions[t.y] - s.positions[t.x], s.positions[t.z] - s.positions[t.x]);
}

/// An edge with the corner numbers (0 to 2) it starts from in its two triangles.
struct SharedEdge {
  uint64_t key;
  unsigned triangle;
  int corner;
};

/// Every edge twice, the two records of an edge next to each other.
std::vector<SharedEdge> pairedEdges(const Surface& s) {
  std::vector<SharedEdge> edges;
  edges.reserve(3 * s.triangles.size());
  for (unsigned t = 0; t < s.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      edges.push_back({edgeKey(s.triangles[t][k], s.triangles[t][(k + 1) % 3]), t, k});
  std::sort(edges.begin(), edges.end(), [](const SharedEdge& a, const SharedEdge& b) {
    return std::pair(a.key, a.triangle) < std::pair(b.key, b.triangle);
  });
  return edges;
}

double cotangent(const glm::dvec3& u, const glm::dvec3& v) {
  return glm::dot(u, v) / std::max(glm::length(glm::cross(u, v)), 1e-30);
}

class Flipper {
 public:
  explicit Flipper(Surface& surface) : s_(surface), touched_(surface.triangles.size(), false) {
    for (const glm::uvec3& t : s_.triangles)
      for (int k = 0; k < 3; ++k) edges_.insert(edgeKey(t[k], t[(k + 1) % 3]));
  }

  void run() {
    const std::vector<SharedEdge> paired = pairedEdges(s_);
    for (size_t i = 0; i + 1 < paired.size(); i += 2) tryFlip(paired[i], paired[i + 1]);
  }

 private:
  /// Flips the edge when the angles opposite it sum to more than half a turn and the surface is flat enough
  /// there.
  void tryFlip(const SharedEdge& first, const SharedEdge& second) {
    if (touched_[first.triangle] || touched_[second.triangle]) return;
    glm::uvec3 &t0 = s_.triangles[first.triangle], &t1 = s_.triangles[second.triangle];
    const unsigned a = t0[first.corner], b = t0[(first.corner + 1) % 3], c = t0[(first.corner + 2) % 3];
    const unsigned d = t1[(second.corner + 2) % 3];
    const glm::dvec3 &pa = s_.positions[a], &pb = s_.positions[b], &pc = s_.positions[c],
                     &pd = s_.positions[d];
    if (cotangent(pa - pc, pb - pc) + cotangent(pa - pd, pb - pd) >= -1e-9) return;
    if (edges_.contains(edgeKey(c, d))) return;
    const glm::uvec3 n0(c, d, b), n1(d, c, a);
    const glm::dvec3 old_normal = glm::normalize(areaNormal(s_, t0) + areaNormal(s_, t1));
    constexpr double kFlat = 0.8;
    for (const glm::uvec3& t : {t0, t1, n0, n1}) {
      const glm::dvec3 n = areaNormal(s_, t);
      if (glm::dot(n, old_normal) < kFlat * glm::length(n)) return;
    }
    edges_.erase(edgeKey(a, b));
    edges_.insert(edgeKey(c, d));
    t0 = n0;
    t1 = n1;
    touched_[first.triangle] = touched_[second.triangle] = true;
  }

  Surface& s_;
  std::vector<bool> touched_;
  std::unordered_set<uint64_t> edges_;
};

/// Half way to the mean of the neighbours, weighted by the triangles' areas, within the tangent plane.
void smoothAlongSurface(Surface& s) {
  std::vector<glm::dvec3> normal(s.positions.size(), glm::dvec3(0)), mean(s.positions.size(), glm::dvec3(0));
  std::vector<double> weight(s.positions.size(), 0);
  for (const glm::uvec3& t : s.triangles) {
    const glm::dvec3 n = areaNormal(s, t);
    const double area = glm::length(n);
    const glm::dvec3 middle = (s.positions[t.x] + s.positions[t.y] + s.positions[t.z]) / 3.0;
    for (int k = 0; k < 3; ++k) {
      normal[t[k]] += n;
      mean[t[k]] += area * middle;
      weight[t[k]] += area;
    }
  }
  for (size_t v = 0; v < s.positions.size(); ++v) {
    const glm::dvec3 n = glm::normalize(normal[v]);
    const glm::dvec3 to_mean = mean[v] / weight[v] - s.positions[v];
    s.positions[v] += 0.5 * (to_mean - glm::dot(to_mean, n) * n);
  }
}

}  // namespace

void projectOnto(const Field& field, Surface& surface, int steps, double longest_step) {
  for (glm::dvec3& p : surface.positions)
    for (int i = 0; i < steps; ++i) p = steppedToSurface(field, p, longest_step);
}

void relax(const Field& field, Surface& surface, int rounds, double longest_step) {
  for (int round = 0; round < rounds; ++round) {
    Flipper(surface).run();
    smoothAlongSurface(surface);
    projectOnto(field, surface, 1, longest_step);
  }
  Flipper(surface).run();
}

Surface surfaceOf(const Field& field, const ModelPlan& plan) {
  Surface surface = contour(field, plan.bounds, plan.cell);
  projectOnto(field, surface, 1, 0.5 * plan.cell);
  reduceTo(surface, plan.triangles, plan.evenness);
  relax(field, surface, plan.relax_rounds, 0.5 * plan.cell);
  return surface;
}

}  // namespace lychnite::builtin
