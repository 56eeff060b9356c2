#include "reference/walk_distance.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lychnite {

namespace {

/// Whether a triangle meets the box of half size `half` about the origin (separating axes, Akenine-Moller
/// 2001).
bool triangleMeetsBox(const std::array<glm::vec3, 3>& t, float half) {
  const auto separated = [&](const glm::vec3& axis) {
    const float a = glm::dot(t[0], axis), b = glm::dot(t[1], axis), c = glm::dot(t[2], axis);
    const float reach = half * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
    return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
  };
  const std::array<glm::vec3, 3> edges = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 unit(0);
    unit[axis] = 1;
    if (separated(unit)) return false;
    for (const glm::vec3& edge : edges)
      if (separated(glm::cross(unit, edge))) return false;
  }
  return !separated(glm::cross(edges[0], edges[1]));
}

/// Squared distances along one line: result[i] = min over j of values[j] + (i - j)^2 (Felzenszwalb &
/// Huttenlocher 2012), in units of a cell.
class LineTransform {
 public:
  explicit LineTransform(size_t n) : values(n), envelope_(n), from_(n + 1), result_(n) {}

  std::vector<float> values;

  const std::vector<float>& transform() {
    const int n = int(values.size());
    int last = -1;
    for (int q = 0; q < n; ++q) {
      if (values[size_t(q)] >= kFar) continue;
      float start = -kFar;
      while (last >= 0 && (start = meet(q, envelope_[size_t(last)])) <= from_[size_t(last)]) --last;
      envelope_[size_t(++last)] = q;
      from_[size_t(last)] = last == 0 ? -kFar : start;
    }
    if (last < 0) return values;
    for (int q = 0, k = 0; q < n; ++q) {
      while (k < last && from_[size_t(k + 1)] < float(q)) ++k;
      const float d = float(q - envelope_[size_t(k)]);
      result_[size_t(q)] = d * d + values[size_t(envelope_[size_t(k)])];
    }
    return result_;
  }

  static constexpr float kFar = 1e12f;

 private:
  float meet(int q, int p) const {
    return ((values[size_t(q)] + float(q * q)) - (values[size_t(p)] + float(p * p))) / float(2 * q - 2 * p);
  }

  std::vector<int> envelope_;
  std::vector<float> from_, result_;
};

}  // namespace

WalkDistance::WalkDistance(const RayScene& rays, int object, int longest) {
  const auto& positions = rays.mesh(object).positions;
  glm::vec3 low = positions.front(), high = low;
  for (const glm::vec3& p : positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::vec3 extent = high - low;
  cell_ = std::max({extent.x, extent.y, extent.z}) / float(longest - 2);
  perCell_ = 1 / cell_;
  min_ = low - cell_;
  size_ = glm::uvec3(glm::ceil(extent * perCell_)) + 2u;
  const std::vector<uint8_t> touched = touchedCells(rays, object);

  std::vector<float> squared(touched.size());
  for (size_t i = 0; i < touched.size(); ++i) squared[i] = touched[i] ? 0.0f : LineTransform::kFar;
  const std::array<size_t, 3> stride = {1, size_.x, size_t(size_.x) * size_.y};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    const auto length = size_t(size_[axis]);
    tbb::parallel_for(0u, uint32_t(size_[v]), [&](uint32_t j) {
      LineTransform line(length);
      for (uint32_t i = 0; i < size_[u]; ++i) {
        float* first = &squared[i * stride[size_t(u)] + j * stride[size_t(v)]];
        for (size_t k = 0; k < length; ++k) line.values[k] = first[k * stride[size_t(axis)]];
        const auto& result = line.transform();
        for (size_t k = 0; k < length; ++k) first[k * stride[size_t(axis)]] = result[k];
      }
    });
  }
  // Between cell centres; the surface may be anywhere in the touched cell.
  const float halfDiagonal = 0.5f * std::sqrt(3.0f);
  bound_.resize(squared.size());
  for (size_t i = 0; i < squared.size(); ++i) {
    const float cells = std::sqrt(squared[i]) * (1 - 1e-5f) - halfDiagonal;
    bound_[i] = uint8_t(std::clamp(std::floor(kPerCell * cells), 0.0f, 255.0f));
  }
}

std::vector<uint8_t> WalkDistance::touchedCells(const RayScene& rays, int object) const {
  std::vector<uint8_t> touched(size_t(size_.x) * size_.y * size_.z, 0);
  const auto mark = [&](const RayMesh& mesh) {
    for (const glm::uvec3& t : *mesh.triangles) {
      std::array<glm::vec3, 3> corner;
      for (int c = 0; c < 3; ++c) corner[size_t(c)] = (mesh.positions[t[c]] - min_) * perCell_;
      const glm::vec3 low = glm::min(corner[0], glm::min(corner[1], corner[2])) - 1e-3f;
      const glm::vec3 high = glm::max(corner[0], glm::max(corner[1], corner[2])) + 1e-3f;
      const glm::ivec3 first = glm::max(glm::ivec3(glm::floor(low)), 0);
      const glm::ivec3 last = glm::min(glm::ivec3(glm::floor(high)), glm::ivec3(size_) - 1);
      for (int k = first.z; k <= last.z; ++k)
        for (int j = first.y; j <= last.y; ++j)
          for (int i = first.x; i <= last.x; ++i) {
            const glm::vec3 centre(float(i) + 0.5f, float(j) + 0.5f, float(k) + 0.5f);
            if (triangleMeetsBox({corner[0] - centre, corner[1] - centre, corner[2] - centre}, 0.501f))
              touched[(size_t(k) * size_.y + size_t(j)) * size_.x + size_t(i)] = 1;
          }
    }
  };
  mark(rays.mesh(object));
  for (int other = 0; other < int(rays.objectCount()); ++other)
    if (rays.opaque(other)) mark(rays.mesh(other));
  return touched;
}

}  // namespace lychnite
