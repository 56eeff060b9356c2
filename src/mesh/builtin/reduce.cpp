#include "mesh/builtin/reduce.h"

#include <algorithm>
#include <cassert>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <queue>

namespace lychnite::builtin {
namespace {

/// Sum of area-weighted squared distances to planes: x'Ax + 2 b'x + c.
struct Quadric {
  glm::dmat3 a{0};
  glm::dvec3 b{0};
  double c = 0, area = 0;

  void add(const Quadric& q) {
    a += q.a;
    b += q.b;
    c += q.c;
    area += q.area;
  }
  double at(const glm::dvec3& p) const { return glm::dot(p, a * p) + 2 * glm::dot(b, p) + c; }
};

struct Collapse {
  double cost;
  unsigned keep, drop;
  unsigned keep_version, drop_version;

  /// Dearest first, so that the queue's top is the cheapest; ties by vertex for one order on every machine.
  bool operator<(const Collapse& o) const {
    if (cost != o.cost) return cost > o.cost;
    return std::pair(keep, drop) > std::pair(o.keep, o.drop);
  }
};

class Reducer {
 public:
  Reducer(Surface& surface, double evenness) : s_(surface), evenness_(evenness) {
    const size_t n = s_.positions.size();
    around_.resize(n);
    quadrics_.resize(n);
    version_.resize(n);
    alive_.assign(s_.triangles.size(), true);
    for (unsigned t = 0; t < s_.triangles.size(); ++t) {
      const Quadric q = planeOf(s_.triangles[t]);
      for (int k = 0; k < 3; ++k) {
        around_[s_.triangles[t][k]].push_back(t);
        quadrics_[s_.triangles[t][k]].add(q);
      }
    }
    std::vector<Collapse> all;
    all.reserve(3 * s_.triangles.size());
    for (const glm::uvec3& t : s_.triangles)
      for (int k = 0; k < 3; ++k)
        if (t[k] < t[(k + 1) % 3]) all.push_back(candidate(t[k], t[(k + 1) % 3]));
    queue_ = std::priority_queue<Collapse>({}, std::move(all));
  }

  void run(size_t target) {
    size_t count = s_.triangles.size();
    while (count > target) {
      assert(!queue_.empty() && "no edge is left to collapse");
      const Collapse c = queue_.top();
      queue_.pop();
      if (version_[c.keep] != c.keep_version || version_[c.drop] != c.drop_version) continue;
      const glm::dvec3 place = bestPlace(c.keep, c.drop);
      if (!linkHolds(c.keep, c.drop) || !shapesHold(c.keep, c.drop, place) ||
          !shapesHold(c.drop, c.keep, place))
        continue;
      collapse(c.keep, c.drop, place);
      count -= 2;
    }
    compact();
  }

 private:
  Quadric planeOf(const glm::uvec3& t) const {
    const glm::dvec3 &p0 = s_.positions[t.x], &p1 = s_.positions[t.y], &p2 = s_.positions[t.z];
    const glm::dvec3 cross = glm::cross(p1 - p0, p2 - p0);
    const double twice = glm::length(cross);
    Quadric q;
    if (!(twice > 0)) return q;
    const glm::dvec3 n = cross / twice;
    const double d = -glm::dot(n, p0), w = twice / 6;
    q.a = w * glm::outerProduct(n, n);
    q.b = w * d * n;
    q.c = w * d * d;
    q.area = w;
    return q;
  }

  Quadric both(unsigned a, unsigned b) const {
    Quadric q = quadrics_[a];
    q.add(quadrics_[b]);
    return q;
  }

  /// The least quadric error, held near the edge's middle where the planes leave it free.
  glm::dvec3 bestPlace(unsigned a, unsigned b) const {
    const Quadric q = both(a, b);
    const glm::dvec3 middle = 0.5 * (s_.positions[a] + s_.positions[b]);
    const double hold = 0.02 * q.area + 1e-18;
    return glm::inverse(q.a + glm::dmat3(hold)) * (hold * middle - q.b);
  }

  Collapse candidate(unsigned a, unsigned b) const {
    const Quadric q = both(a, b);
    const glm::dvec3 edge = s_.positions[a] - s_.positions[b];
    const double cost = std::max(q.at(bestPlace(a, b)), 0.0) + evenness_ * q.area * glm::dot(edge, edge);
    return {cost, a, b, version_[a], version_[b]};
  }

  std::vector<unsigned> neighbours(unsigned v) const {
    std::vector<unsigned> list;
    list.reserve(2 * around_[v].size());
    for (unsigned t : around_[v])
      for (int k = 0; k < 3; ++k)
        if (s_.triangles[t][k] != v) list.push_back(s_.triangles[t][k]);
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
  }

  /// Exactly the two opposite corners may be neighbours of both ends.
  bool linkHolds(unsigned a, unsigned b) const {
    constexpr size_t kMostNeighbours = 10;  // a vertex with more has thin triangles
    // A vertex of a closed surface has as many neighbours as triangles.
    if (around_[a].size() + around_[b].size() - 4 > kMostNeighbours) return false;
    const std::vector<unsigned> na = neighbours(a), nb = neighbours(b);
    std::vector<unsigned> shared;
    std::set_intersection(na.begin(), na.end(), nb.begin(), nb.end(), std::back_inserter(shared));
    return shared.size() == 2 && around_[shared[0]].size() > 3 && around_[shared[1]].size() > 3;
  }

  /// No triangle of `v` that stays may turn over, or become a sliver, when v moves to `place`.
  bool shapesHold(unsigned v, unsigned other, const glm::dvec3& place) const {
    for (unsigned t : around_[v]) {
      const glm::uvec3& tri = s_.triangles[t];
      if (tri.x == other || tri.y == other || tri.z == other) continue;
      glm::dvec3 p[3];
      for (int k = 0; k < 3; ++k) p[k] = s_.positions[tri[k]];
      const glm::dvec3 before = glm::cross(p[1] - p[0], p[2] - p[0]);
      for (int k = 0; k < 3; ++k)
        if (tri[k] == v) p[k] = place;
      const glm::dvec3 after = glm::cross(p[1] - p[0], p[2] - p[0]);
      const double size_after = glm::length(after);
      const double edges = glm::dot(p[1] - p[0], p[1] - p[0]) + glm::dot(p[2] - p[1], p[2] - p[1]) +
                           glm::dot(p[0] - p[2], p[0] - p[2]);
      if (size_after < 0.05 * edges) return false;
      if (glm::dot(before, after) < 0.3 * glm::length(before) * size_after) return false;
    }
    return true;
  }

  void collapse(unsigned keep, unsigned drop, const glm::dvec3& place) {
    for (unsigned t : around_[drop]) {
      glm::uvec3& tri = s_.triangles[t];
      if (tri.x == keep || tri.y == keep || tri.z == keep) {
        alive_[t] = false;
        for (int k = 0; k < 3; ++k)
          if (tri[k] != drop) std::erase(around_[tri[k]], t);
        continue;
      }
      for (int k = 0; k < 3; ++k)
        if (tri[k] == drop) tri[k] = keep;
      around_[keep].push_back(t);
    }
    around_[drop].clear();
    s_.positions[keep] = place;
    quadrics_[keep].add(quadrics_[drop]);
    ++version_[drop];
    ++version_[keep];
    for (unsigned n : neighbours(keep)) queue_.push(candidate(std::min(keep, n), std::max(keep, n)));
  }

  void compact() {
    std::vector<unsigned> new_id(s_.positions.size());
    unsigned count = 0;
    for (size_t v = 0; v < s_.positions.size(); ++v) {
      if (around_[v].empty()) continue;
      new_id[v] = count;
      s_.positions[count++] = s_.positions[v];
    }
    s_.positions.resize(count);
    std::vector<glm::uvec3> left;
    for (size_t t = 0; t < s_.triangles.size(); ++t) {
      const glm::uvec3& tri = s_.triangles[t];
      if (alive_[t]) left.emplace_back(new_id[tri.x], new_id[tri.y], new_id[tri.z]);
    }
    s_.triangles = std::move(left);
  }

  Surface& s_;
  double evenness_;
  std::vector<std::vector<unsigned>> around_;  ///< the triangles of each vertex
  std::vector<Quadric> quadrics_;
  std::vector<unsigned> version_;
  std::vector<bool> alive_;
  std::priority_queue<Collapse> queue_;
};

}  // namespace

void reduceTo(Surface& surface, size_t triangles, double evenness) {
  assert(triangles % 2 == surface.triangles.size() % 2 && triangles <= surface.triangles.size());
  Reducer(surface, evenness).run(triangles);
}

}  // namespace lychnite::builtin
