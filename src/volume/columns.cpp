#include "volume/columns.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace lychnite::volume {

namespace {

// Corners are moved to whole numbers of this many steps per line, so that the test of a line against an edge
// is exact and a line through an edge meets exactly one of its two triangles.
constexpr int64_t kSteps = 4096;

/// A triangle seen along the axis, in whole steps.
struct Projected {
  int64_t x[3], y[3];
  double z[3];
  int64_t area = 0;  ///< twice, signed

  int64_t edge(int i, int64_t px, int64_t py) const {
    const int j = (i + 1) % 3;
    return (x[j] - x[i]) * (py - y[i]) - (y[j] - y[i]) * (px - x[i]);
  }
  /// Lines on an edge belong to the triangle that lies to the edge's left or above it (counter-clockwise).
  bool owns(int i) const {
    const int j = (i + 1) % 3;
    const int64_t dx = x[j] - x[i], dy = y[j] - y[i];
    return dy < 0 || (dy == 0 && dx < 0);
  }
};

int shortestAxis(const glm::dvec3& extent) {
  return extent.z <= extent.x && extent.z <= extent.y ? 2 : extent.y <= extent.x ? 1 : 0;
}

template <class Visit>
void visitLines(const Projected& t, int64_t width, int64_t height, Visit visit) {
  // Line (i, j) lies at ((i + 1/2) steps, (j + 1/2) steps).
  const auto lower = [](int64_t a, int64_t b, int64_t c) {
    return std::max<int64_t>(0, (std::min({a, b, c}) - kSteps / 2 + kSteps - 1) / kSteps);
  };
  const auto upper = [](int64_t a, int64_t b, int64_t c, int64_t most) {
    return std::min<int64_t>(most - 1, (std::max({a, b, c}) - kSteps / 2) / kSteps);
  };
  const int64_t i0 = lower(t.x[0], t.x[1], t.x[2]), i1 = upper(t.x[0], t.x[1], t.x[2], width);
  const int64_t j0 = lower(t.y[0], t.y[1], t.y[2]), j1 = upper(t.y[0], t.y[1], t.y[2], height);
  for (int64_t j = j0; j <= j1; ++j)
    for (int64_t i = i0; i <= i1; ++i) {
      const int64_t px = i * kSteps + kSteps / 2, py = j * kSteps + kSteps / 2;
      int64_t w[3];
      bool inside = true;
      for (int e = 0; e < 3 && inside; ++e) {
        w[e] = t.edge(e, px, py);
        inside = w[e] > 0 || (w[e] == 0 && t.owns(e));
      }
      if (!inside) continue;
      const double z =
          (double(w[1]) * t.z[0] + double(w[2]) * t.z[1] + double(w[0]) * t.z[2]) / double(t.area);
      visit(int(i), int(j), float(z));
    }
}

}  // namespace

LocalMesh::LocalMesh(const Mesh& mesh) : triangles(&mesh.triangles) {
  const Bounds bounds = extentOf(mesh).bounds;
  const double longest = bounds.longestSide();
  extent = bounds.extent() / longest;
  positions.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions) positions.push_back((glm::dvec3(p) - bounds.centre()) / longest);
}

Columns::Columns(const LocalMesh& mesh, double cell, int perCell)
    : axis_(shortestAxis(mesh.extent)), perCell_(perCell), pitch_(cell / perCell) {
  for (int a = 0; a < 3; ++a) {
    cells_[a] = int(std::ceil(mesh.extent[a] / cell - 1e-9)) + 2;
    origin_[a] = -0.5 * cells_[a] * cell;
  }
  std::vector<uint32_t> first;
  std::vector<Crossing> all = crossings(mesh, first);
  makeIntervals(all, first);
}

/// All crossings, line by line; `first` has one entry a line and one more.
std::vector<Columns::Crossing> Columns::crossings(const LocalMesh& mesh, std::vector<uint32_t>& first) const {
  const int width = across(u()), height = across(v());
  const double scale = double(kSteps) / pitch_;
  const auto project = [&](const glm::uvec3& t, Projected& p) {
    for (int c = 0; c < 3; ++c) {
      const glm::dvec3& q = mesh.positions[t[c]];
      p.x[c] = std::llround((q[u()] - origin_[u()]) * scale);
      p.y[c] = std::llround((q[v()] - origin_[v()]) * scale);
      p.z[c] = q[axis_];
    }
    p.area = (p.x[1] - p.x[0]) * (p.y[2] - p.y[0]) - (p.y[1] - p.y[0]) * (p.x[2] - p.x[0]);
    if (p.area == 0) return 0;
    if (p.area > 0) return -1;  // faces up the axis: the way out
    std::swap(p.x[1], p.x[2]);
    std::swap(p.y[1], p.y[2]);
    std::swap(p.z[1], p.z[2]);
    p.area = -p.area;
    return 1;
  };
  struct Met {
    uint32_t line;
    Crossing crossing;
  };
  std::vector<Met> met;
  first.assign(size_t(width) * size_t(height) + 1, 0);
  Projected p;
  for (const glm::uvec3& t : *mesh.triangles) {
    const int turn = project(t, p);
    if (turn == 0) continue;
    visitLines(p, width, height, [&](int i, int j, float z) {
      met.push_back({uint32_t(index(i, j)), {z, int8_t(turn)}});
      ++first[index(i, j) + 1];
    });
  }
  for (size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<Crossing> result(met.size());
  std::vector<uint32_t> at(first.begin(), first.end() - 1);
  for (const Met& m : met) result[at[m.line]++] = m.crossing;
  return result;
}

void Columns::makeIntervals(std::vector<Crossing>& all, const std::vector<uint32_t>& first) {
  const size_t lines = first.size() - 1;
  first_.assign(lines + 1, 0);
  size_t met = 0, undefined = 0;
  for (size_t line = 0; line < lines; ++line) {
    first_[line] = uint32_t(intervals_.size());
    Crossing *begin = all.data() + first[line], *end = all.data() + first[line + 1];
    if (begin == end) continue;
    ++met;
    // Of crossings at one place the way in comes first: touching shells hold together.
    std::sort(begin, end, [](const Crossing& a, const Crossing& b) {
      return a.at != b.at ? a.at < b.at : a.turn > b.turn;
    });
    int winding = 0;
    bool defined = true;
    for (const Crossing* c = begin; c != end; ++c) {
      winding += c->turn;
      if (winding == 1 && c->turn > 0) intervals_.push_back({c->at, c->at});
      if (winding == 0 && c->turn < 0) intervals_.back().high = c->at;
      defined = defined && winding >= 0;
      if (!defined) break;
    }
    if (defined && winding == 0) continue;
    ++undefined;
    // What the line before it met stands in for it.
    intervals_.resize(first_[line]);
    if (line > 0)
      for (uint32_t i = first_[line - 1]; i < first_[line]; ++i) {
        const Interval before = intervals_[i];
        intervals_.push_back(before);
      }
  }
  first_[lines] = uint32_t(intervals_.size());
  undefined_ = met > 0 ? double(undefined) / double(met) : 1;
}

double undefinedInside(const LocalMesh& mesh) {
  double share = 0;
  for (int turn = 0; turn < 3; ++turn) {
    // The same shape with its axes renamed, so that each of them is the lines' once.
    LocalMesh renamed = mesh;
    for (glm::dvec3& p : renamed.positions) p = {p[(turn + 1) % 3], p[(turn + 2) % 3], p[turn]};
    renamed.extent = glm::dvec3(1, 1, 0.999);
    share = std::max(share, Columns(renamed, 1.0 / 96, 1).undefinedShare());
  }
  return share;
}

}  // namespace lychnite::volume
