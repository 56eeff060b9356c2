#include "volume/surface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numeric>

#include "volume/interruptible.h"

namespace lychnite::volume {

namespace {

// Longest edge of a triangle that is one sample, and of a sample of a larger one, in voxels: finer, so that
// cells beside each other get equal shares of a large flat face.
constexpr double kLongest = 0.55, kSpacing = 0.3;
constexpr float kLeastDepth = 0.05f;  // of a centroid under the surface, in voxels
constexpr int kMostCuts = 2048;

struct SubTriangle {
  int row, column, upper;
};

/// Numbering of the m x m pieces: row r holds 2 (m - r) - 1, alternately upright and turned.
int pieceIndex(int m, const SubTriangle& s) {
  return s.row * (2 * m - s.row) + 2 * s.column + s.upper;
}

SubTriangle pieceOf(int m, int index) {
  int row = int(double(m) - std::sqrt(std::max(0.0, double(m) * m - index)));
  while (row > 0 && row * (2 * m - row) > index) --row;
  while ((row + 1) * (2 * m - row - 1) <= index) ++row;
  const int rest = index - row * (2 * m - row);
  return {row, rest / 2, rest % 2};
}

/// Weights of the middle of a piece moved by (x, y) in its own weights.
glm::vec2 piecePoint(int m, const SubTriangle& s, float x, float y) {
  const auto step = 1.0f / float(m);
  if (s.upper) return {(float(s.column) + 1 - x) * step, (float(s.row) + 1 - y) * step};
  return {(float(s.column) + x) * step, (float(s.row) + y) * step};
}

int cutsOf(uint32_t pieces) {
  return int(std::lround(std::sqrt(double(pieces))));
}

/// Which of the 24 sectors of the sphere (largest axis, three signs) a normal lies in.
int directionOf(const glm::vec3& n) {
  const glm::vec3 a = glm::abs(n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return 8 * axis + (n.x > 0 ? 1 : 0) + (n.y > 0 ? 2 : 0) + (n.z > 0 ? 4 : 0);
}

}  // namespace

Surface::Surface(const LocalMesh& mesh, const Grid& grid) : grid_(grid) {
  Interruptible::check();
  cutTriangles(mesh);
  Interruptible::check();
  findOwners();
  Interruptible::check();
  makeNodes();
  orderByCell();
}

void Surface::cutTriangles(const LocalMesh& mesh) {
  const double h = grid_.side();
  const auto& triangles = *mesh.triangles;
  firstSample_.reserve(triangles.size() + 1);
  samples_.reserve(triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    firstSample_.push_back(uint32_t(samples_.size()));
    const glm::dvec3 a = mesh.positions[triangles[t].x], b = mesh.positions[triangles[t].y],
                     c = mesh.positions[triangles[t].z];
    const glm::dvec3 across = glm::cross(b - a, c - a);
    const double twice = glm::length(across);
    const double edge = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    const int m = edge > kLongest * h ? std::min(int(std::ceil(edge / (kSpacing * h))), kMostCuts) : 1;
    Sample sample;
    sample.normal = twice > 0 ? glm::vec3(across / twice) : glm::vec3(0, 1, 0);
    sample.area = float(0.5 * twice / (double(m) * m));
    sample.triangle = t;
    for (int i = 0; i < m * m; ++i) {
      const glm::dvec2 w = piecePoint(m, pieceOf(m, i), 1.0f / 3, 1.0f / 3);
      sample.position = glm::vec3(a + w.x * (b - a) + w.y * (c - a));
      samples_.push_back(sample);
    }
    area_ += 0.5 * twice;
  }
  firstSample_.push_back(uint32_t(samples_.size()));
}

uint32_t Surface::sampleAt(uint32_t triangle, float u, float v) const {
  const uint32_t first = firstSample_[triangle], pieces = firstSample_[triangle + 1] - first;
  if (pieces == 1) return first;
  const int m = cutsOf(pieces);
  const float x = std::clamp(u, 0.0f, 1.0f) * float(m), y = std::clamp(v, 0.0f, 1.0f) * float(m);
  SubTriangle s{std::min(int(y), m - 1), 0, 0};
  s.column = std::clamp(int(x), 0, m - 1 - s.row);
  s.upper = x - float(s.column) + y - float(s.row) > 1 && s.column < m - 1 - s.row ? 1 : 0;
  return first + uint32_t(pieceIndex(m, s));
}

glm::vec2 Surface::pointOf(uint32_t sample, float x, float y) const {
  const uint32_t triangle = samples_[sample].triangle, first = firstSample_[triangle];
  const int m = cutsOf(firstSample_[triangle + 1] - first);
  if (x + y > 1) x = 1 - x, y = 1 - y;
  return piecePoint(m, pieceOf(m, int(sample - first)), x, y);
}

/// The first cell behind a sample that the columns know of.
void Surface::findOwners() {
  const auto h = float(grid_.side());
  tbb::parallel_for(size_t(0), samples_.size(), [&](size_t i) {
    Sample& s = samples_[i];
    for (const float behind : {0.02f, 0.08f, 0.2f, 0.35f, 0.5f, 0.75f, 1.0f, 1.5f}) {
      s.cell = grid_.find(s.position - behind * h * s.normal);
      if (s.cell != Grid::kNone) break;
    }
    if (s.cell == Grid::kNone) return;
    s.depth = std::max(kLeastDepth * h, glm::dot(s.normal, s.position - grid_.cell(s.cell).centroid));
  });
}

/// Samples of one cell, one half-voxel and one main direction.
void Surface::makeNodes() {
  struct Key {
    uint64_t voxel;
    uint64_t rest;
    uint32_t sample;
  };
  std::vector<Key> keys(samples_.size());
  tbb::parallel_for(size_t(0), samples_.size(), [&](size_t i) {
    const Sample& s = samples_[i];
    const glm::vec3 q = grid_.voxels(s.position);
    const glm::ivec3 v(glm::floor(q));
    const glm::vec3 in = q - glm::vec3(v);
    const uint64_t half = uint64_t(in.x >= 0.5f) | uint64_t(in.y >= 0.5f) << 1 | uint64_t(in.z >= 0.5f) << 2;
    keys[i] = {grid_.voxelIndex(v), (uint64_t(s.cell) << 8) | (half << 5) | uint64_t(directionOf(s.normal)),
               uint32_t(i)};
  });
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return a.voxel != b.voxel ? a.voxel < b.voxel : a.rest != b.rest ? a.rest < b.rest : a.sample < b.sample;
  });
  firstNode_.assign(grid_.voxelCount() + 1, 0);
  for (size_t i = 0; i < keys.size(); ++i) {
    if (i == 0 || keys[i].voxel != keys[i - 1].voxel || keys[i].rest != keys[i - 1].rest) {
      nodes_.emplace_back();
      nodes_.back().cell = samples_[keys[i].sample].cell;
      ++firstNode_[keys[i].voxel + 1];
    }
    Sample& s = samples_[keys[i].sample];
    s.node = uint32_t(nodes_.size() - 1);
    Node& node = nodes_.back();
    node.position += s.area * s.position;
    node.normal += s.area * s.normal;
    node.area += s.area;
  }
  std::partial_sum(firstNode_.begin(), firstNode_.end(), firstNode_.begin());
  samplesOfNodes_.reserve(keys.size());
  for (const Key& key : keys) {
    const uint32_t node = samples_[key.sample].node;
    if (firstSampleOfNode_.size() == node) firstSampleOfNode_.push_back(uint32_t(samplesOfNodes_.size()));
    samplesOfNodes_.push_back(key.sample);
  }
  firstSampleOfNode_.push_back(uint32_t(samplesOfNodes_.size()));
  for (size_t n = 0; n < nodes_.size(); ++n) {
    Node& node = nodes_[n];
    if (node.area > 0) node.position /= node.area;
    const float length = glm::length(node.normal);
    node.normal = length > 0 ? node.normal / length : glm::vec3(0, 1, 0);
  }
}

void Surface::orderByCell() {
  firstOfCell_.assign(grid_.size() + 1, 0);
  for (const Node& node : nodes_)
    if (node.cell != Grid::kNone) ++firstOfCell_[node.cell + 1];
  std::partial_sum(firstOfCell_.begin(), firstOfCell_.end(), firstOfCell_.begin());
  nodesOfCells_.resize(firstOfCell_.back());
  std::vector<uint32_t> at(firstOfCell_.begin(), firstOfCell_.end() - 1);
  for (uint32_t n = 0; n < nodes_.size(); ++n)
    if (nodes_[n].cell != Grid::kNone) nodesOfCells_[at[nodes_[n].cell]++] = n;
}

Surface::Place Surface::place(const glm::vec3& p) const {
  Place place;
  place.cell = grid_.find(p);
  uint32_t nearest = Grid::kNone;
  float distance = std::numeric_limits<float>::infinity();
  const auto look = [&](uint32_t n) {
    const glm::vec3 way = nodes_[n].position - p;
    if (nodes_[n].cell == Grid::kNone || glm::dot(way, way) >= distance) return;
    distance = glm::dot(way, way);
    nearest = n;
  };
  if (place.cell == Grid::kNone) {
    around(p, look);
    if (nearest == Grid::kNone) return place;
    place.cell = nodes_[nearest].cell;
  } else {
    for (uint32_t i = firstOfCell_[place.cell]; i < firstOfCell_[place.cell + 1]; ++i) look(nodesOfCells_[i]);
    if (nearest == Grid::kNone) return place;
  }
  distance = std::numeric_limits<float>::infinity();
  for (uint32_t i = firstSampleOfNode_[nearest]; i < firstSampleOfNode_[nearest + 1]; ++i) {
    const Sample& s = samples_[samplesOfNodes_[i]];
    const glm::vec3 way = s.position - p;
    if (glm::dot(way, way) < distance) distance = glm::dot(way, way), place.sample = samplesOfNodes_[i];
  }
  const Sample& s = samples_[place.sample];
  place.depth = std::max(0.0f, glm::dot(s.normal, s.position - p));
  return place;
}

size_t Surface::memoryBytes() const {
  return samples_.capacity() * sizeof(Sample) + nodes_.capacity() * sizeof(Node) +
         (firstSample_.capacity() + samplesOfNodes_.capacity() + firstSampleOfNode_.capacity() +
          nodesOfCells_.capacity() + firstOfCell_.capacity() + firstNode_.capacity()) *
             4;
}

}  // namespace lychnite::volume
