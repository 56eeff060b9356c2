#include "volume/grid.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "volume/grid_builder.h"

namespace lychnite::volume {

namespace {

// Lines across the longest side of a shape, at least: thickness along the two raster axes is known to a share
// of this.
constexpr int kLines = 256;

}  // namespace

Grid::Grid(const LocalMesh& mesh, int cells) : side_(1.0 / cells), perSide_(float(cells)) {
  const Columns columns(mesh, side_, std::max(3, kLines / cells));
  axis_ = columns.axis();
  perCell_ = columns.perCell();
  pitch_ = float(columns.pitch());
  width_ = columns.across(columns.u());
  origin_ = glm::vec3(columns.origin());
  counts_ = columns.cells();
  undefined_ = columns.undefinedShare();
  Builder(*this, columns).build();
  findDepths();
}

uint32_t Grid::find(const glm::vec3& p) const {
  const glm::vec3 q = voxels(p);
  const glm::ivec3 v(glm::floor(q));
  if (!contains(v)) return kNone;
  const uint32_t cell = voxelCell_[voxelIndex(v)];
  if (cell == kNone) return kNone;
  if (cell != kSeveral && depth_[voxelIndex(v)] > 0) return cell;
  const int u = (axis_ + 1) % 3, w = (axis_ + 2) % 3;
  const int i = std::clamp(int(q[u] * float(perCell_)), 0, width_ - 1);
  const int j = std::clamp(int(q[w] * float(perCell_)), 0, counts_[w] * perCell_ - 1);
  const size_t line = size_t(j) * size_t(width_) + size_t(i);
  const float at = p[axis_];
  const Segment *begin = segments_.data() + firstSegment_[line],
                *end = segments_.data() + firstSegment_[line + 1];
  const Segment* s =
      std::lower_bound(begin, end, at, [](const Segment& a, float value) { return a.high < value; });
  return s != end && s->low <= at ? s->cell : kNone;
}

/// Chessboard distance to the nearest voxel that is not full, by two sweeps.
void Grid::findDepths() {
  const float full = float(side_ * side_ * side_) * 0.9999f;
  depth_.assign(voxelCount(), 0);
  std::vector<float> volume(voxelCount(), 0);
  const int u = (axis_ + 1) % 3, w = (axis_ + 2) % 3;
  for (int j = 0; j < counts_[w] * perCell_; ++j)
    for (int i = 0; i < width_; ++i) {
      const size_t line = size_t(j) * size_t(width_) + size_t(i);
      for (uint32_t s = firstSegment_[line]; s < firstSegment_[line + 1]; ++s) {
        glm::ivec3 v;
        v[u] = i / perCell_;
        v[w] = j / perCell_;
        v[axis_] = int((0.5f * (segments_[s].low + segments_[s].high) - origin_[axis_]) * perSide_);
        volume[voxelIndex(v)] += (segments_[s].high - segments_[s].low) * pitch_ * pitch_;
      }
    }
  for (size_t i = 0; i < volume.size(); ++i) depth_[i] = volume[i] >= full ? 255 : 0;
  const auto sweep = [&](int sign) {
    const size_t count = voxelCount();
    const glm::ivec3 c = counts_;
    for (size_t n = 0; n < count; ++n) {
      const size_t at = sign > 0 ? n : count - 1 - n;
      if (depth_[at] == 0) continue;
      const glm::ivec3 v(int(at % size_t(c.x)), int(at / size_t(c.x) % size_t(c.y)),
                         int(at / (size_t(c.x) * size_t(c.y))));
      int least = depth_[at];
      for (int k = -1; k <= 1; ++k)
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i) {
            const glm::ivec3 o = v + glm::ivec3(i, j, k);
            const bool before = (k * 3 + j) * 3 + i < 0;
            if (before != (sign > 0) || (i == 0 && j == 0 && k == 0)) continue;
            least = std::min(least, contains(o) ? depth_[voxelIndex(o)] + 1 : 1);
          }
      depth_[at] = uint8_t(least);
    }
  };
  sweep(1);
  sweep(-1);
  // A point of a full voxel is clear by the whole voxels around it.
  for (uint8_t& d : depth_) d = d > 0 ? uint8_t(d - 1) : uint8_t(0);
}

size_t Grid::memoryBytes() const {
  return cells_.capacity() * sizeof(Cell) + firstLink_.capacity() * 4 + links_.capacity() * sizeof(Link) +
         voxelCell_.capacity() * 4 + depth_.capacity() + firstSegment_.capacity() * 4 +
         segments_.capacity() * sizeof(Segment);
}

}  // namespace lychnite::volume
