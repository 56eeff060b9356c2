#include "volume/gather.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace lychnite::volume {

namespace {

constexpr float kFacing = 0.05f;  // cosine of normals below which nodes are not of one surface
constexpr float kPerCosine = 20;  // weights fall by e at 18 degrees between normals
constexpr float kLeast = 1e-12f;

}  // namespace

void Gather::weigh(const Shape& shape, const glm::vec3& p, const glm::vec3& normal, uint32_t cell,
                   std::vector<Weight>& weights) {
  weights.clear();
  const auto& nodes = shape.surface.nodes();
  const float perVariance = 0.5f / float(kWidth * kWidth * shape.grid.side() * shape.grid.side());
  float sum = 0;
  shape.surface.around(p, [&](uint32_t n) {
    const auto& node = nodes[n];
    if (node.cell == Grid::kNone) return;
    const float facing = glm::dot(node.normal, normal);
    if (facing < kFacing) return;
    const glm::vec3 way = node.position - p;
    const float x = glm::dot(way, way) * perVariance;
    if (x > 12 || (cell != Grid::kNone && !shape.grid.linked(cell, node.cell))) return;
    const float weight = std::exp((facing - 1) * kPerCosine - x);
    sum += weight * node.area;
    weights.push_back({n, weight});
  });
  for (Weight& w : weights) w.weight /= std::fmax(sum, kLeast);
}

void Gather::weigh(const Shape& shape, const MeshPoint& point, std::vector<Weight>& weights) {
  const Mesh& mesh = *shape.mesh;
  const glm::uvec3& t = mesh.triangles[point.triangle];
  const float w = 1 - point.u - point.v;
  const auto& p = shape.local.positions;
  const glm::vec3 at =
      float(w) * glm::vec3(p[t.x]) + point.u * glm::vec3(p[t.y]) + point.v * glm::vec3(p[t.z]);
  const glm::vec3 normal = w * mesh.normals[t.x] + point.u * mesh.normals[t.y] + point.v * mesh.normals[t.z];
  const auto& sample = shape.surface.samples()[shape.surface.sampleAt(point.triangle, point.u, point.v)];
  const float length = glm::length(normal);
  weigh(shape, at, length > 1e-6f ? normal / length : sample.normal, sample.cell, weights);
}

Gather::Gather(const Shape& shape) {
  const Mesh& mesh = *shape.mesh;
  std::vector<uint32_t> cell(mesh.positions.size(), Grid::kNone);
  const auto& surface = shape.surface;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      uint32_t& at = cell[mesh.triangles[t][c]];
      if (at == Grid::kNone)
        at = surface.samples()[surface.sampleAt(t, c == 1 ? 1.0f : 0.0f, c == 2 ? 1.0f : 0.0f)].cell;
    }
  constexpr size_t kBlock = 512;
  const size_t count = cell.size(), blocks = (count + kBlock - 1) / kBlock;
  std::vector<std::vector<Weight>> parts(blocks);
  std::vector<uint32_t> counts(count);
  tbb::parallel_for(size_t(0), blocks, [&](size_t b) {
    std::vector<Weight> weights;
    for (size_t i = b * kBlock; i < std::min(count, (b + 1) * kBlock); ++i) {
      weigh(shape, glm::vec3(shape.local.positions[i]), mesh.normals[i], cell[i], weights);
      counts[i] = uint32_t(weights.size());
      parts[b].insert(parts[b].end(), weights.begin(), weights.end());
    }
  });
  first_.push_back(0);
  for (const uint32_t n : counts) first_.push_back(first_.back() + n);
  weights_.reserve(first_.back());
  for (const auto& part : parts) weights_.insert(weights_.end(), part.begin(), part.end());
}

std::vector<glm::vec3> Gather::vertices(const std::vector<Lanes>& flux) const {
  std::vector<glm::vec3> result(first_.size() - 1);
  tbb::parallel_for(size_t(0), result.size(), [&](size_t i) {
    Lanes sum{0, 0, 0, 0};
    for (uint32_t w = first_[i]; w < first_[i + 1]; ++w) sum += weights_[w].weight * flux[weights_[w].node];
    result[i] = {sum[0], sum[1], sum[2]};
  });
  return result;
}

}  // namespace lychnite::volume
