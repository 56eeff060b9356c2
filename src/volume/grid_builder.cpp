#include "volume/grid_builder.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "volume/interruptible.h"

namespace lychnite::volume {

namespace {

constexpr double kSmallest = 0.25;  // of a voxel: a smaller part joins a neighbour
constexpr double kNearest = 0.4;    // of a voxel: least distance of two centroids in a conductance
constexpr float kLeastLength = 1e-7f;

}  // namespace

void Grid::Builder::build() {
  for (const auto step : {&Builder::cutSegments, &Builder::joinInVoxels, &Builder::measureParts,
                          &Builder::findOpenings, &Builder::mergeSmall, &Builder::number, &Builder::link}) {
    Interruptible::check();
    (this->*step)();
  }
}

int Grid::Builder::layer(float at) const {
  const int axis = columns.axis();
  return std::clamp(int(std::floor((double(at) - columns.origin()[axis]) / columns.cell())), 0,
                    grid.counts_[axis] - 1);
}

void Grid::Builder::cutSegments() {
  const int axis = columns.axis();
  const int width = columns.across(columns.u()), height = columns.across(columns.v());
  grid.firstSegment_.assign(size_t(width) * size_t(height) + 1, 0);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      grid.firstSegment_[line(i, j)] = uint32_t(grid.segments_.size());
      for (const auto* interval = columns.begin(i, j); interval != columns.end(i, j); ++interval) {
        for (int k = layer(interval->low), last = layer(interval->high); k <= last; ++k) {
          const auto bottom = float(columns.origin()[axis] + k * columns.cell());
          const float low = std::max(interval->low, bottom);
          const float high = std::min(interval->high, bottom + float(columns.cell()));
          if (high - low < kLeastLength) continue;
          grid.segments_.push_back({low, high, kNone});
          layer_.push_back(k);
        }
      }
    }
  grid.firstSegment_.back() = uint32_t(grid.segments_.size());
}

template <class Visit>
void Grid::Builder::touching(size_t lineA, size_t lineB, Visit visit) const {
  const auto& s = grid.segments_;
  uint32_t a = grid.firstSegment_[lineA], b = grid.firstSegment_[lineB];
  const uint32_t endA = grid.firstSegment_[lineA + 1], endB = grid.firstSegment_[lineB + 1];
  while (a < endA && b < endB) {
    const float shared = std::min(s[a].high, s[b].high) - std::max(s[a].low, s[b].low);
    if (layer_[a] == layer_[b] && shared > 0) {
      // Where surfaces lean, the mean of both lengths is the opening between the lines; where bodies of
      // different height touch it is what they share.
      const float mean = 0.5f * (s[a].high - s[a].low + s[b].high - s[b].low);
      visit(a, b, std::min(mean, shared + grid.pitch_));
    }
    (s[a].high <= s[b].high ? a : b) += 1;
  }
}

void Grid::Builder::joinInVoxels() {
  Unions unions(grid.segments_.size());
  const int per = columns.perCell();
  const int width = columns.across(columns.u()), height = columns.across(columns.v());
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const auto join = [&](uint32_t a, uint32_t b, float) { unions.join(a, b); };
      if ((i + 1) % per != 0) touching(line(i, j), line(i + 1, j), join);
      if ((j + 1) % per != 0) touching(line(i, j), line(i, j + 1), join);
    }
  part_.resize(grid.segments_.size());
  uint32_t parts = 0;
  for (uint32_t s = 0; s < part_.size(); ++s) {
    const uint32_t root = unions.root(s);
    part_[s] = root == s ? parts++ : part_[root];
  }
  parts_.resize(parts);
}

void Grid::Builder::measureParts() {
  const int axis = columns.axis(), u = columns.u(), v = columns.v();
  const int width = columns.across(u), height = columns.across(v), per = columns.perCell();
  const double area = columns.pitch() * columns.pitch();
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      for (uint32_t s = grid.firstSegment_[line(i, j)]; s < grid.firstSegment_[line(i, j) + 1]; ++s) {
        const auto& segment = grid.segments_[s];
        Part& part = parts_[part_[s]];
        glm::dvec3 middle;
        middle[axis] = 0.5 * (double(segment.low) + double(segment.high));
        middle[u] = columns.origin()[u] + (i + 0.5) * columns.pitch();
        middle[v] = columns.origin()[v] + (j + 0.5) * columns.pitch();
        const double volume = area * double(segment.high - segment.low);
        part.volume += volume;
        part.moment += volume * middle;
        part.voxel[axis] = layer_[s];
        part.voxel[u] = i / per;
        part.voxel[v] = j / per;
      }
}

/// Adds up the openings of each pair of parts across each axis. Most parts have one neighbour on the upper
/// side of an axis, which has its own slot; the others are sorted.
void Grid::Builder::findOpenings() {
  const int axis = columns.axis(), u = columns.u(), v = columns.v();
  const int width = columns.across(u), height = columns.across(v), per = columns.perCell();
  const auto pitch = float(columns.pitch());
  struct Slot {
    uint32_t to = kNone;
    float area = 0;
  };
  std::vector<Slot> slots(parts_.size() * 3);
  const auto add = [&](uint32_t a, uint32_t b, int across, float area) {
    Slot& slot = slots[size_t(a) * 3 + size_t(across)];
    if (slot.to == kNone) slot.to = b;
    if (slot.to == b)
      slot.area += area;
    else
      openings_.push_back({a, b, uint8_t(across), area});
  };
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const size_t here = line(i, j);
      for (uint32_t s = grid.firstSegment_[here]; s + 1 < grid.firstSegment_[here + 1]; ++s)
        if (layer_[s + 1] == layer_[s] + 1 &&
            grid.segments_[s + 1].low <= grid.segments_[s].high + kLeastLength)
          add(part_[s], part_[s + 1], axis, pitch * pitch);
      const auto sideways = [&](int across) {
        return [&, across](uint32_t a, uint32_t b, float length) {
          add(part_[a], part_[b], across, length * pitch);
        };
      };
      if ((i + 1) % per == 0 && i + 1 < width) touching(here, line(i + 1, j), sideways(u));
      if ((j + 1) % per == 0 && j + 1 < height) touching(here, line(i, j + 1), sideways(v));
    }
  std::sort(openings_.begin(), openings_.end(), [](const Opening& l, const Opening& r) {
    return l.a != r.a ? l.a < r.a : l.b != r.b ? l.b < r.b : l.axis < r.axis;
  });
  size_t kept = 0;
  for (const Opening& o : openings_) {
    if (kept > 0 && openings_[kept - 1].a == o.a && openings_[kept - 1].b == o.b &&
        openings_[kept - 1].axis == o.axis)
      openings_[kept - 1].area += o.area;
    else
      openings_[kept++] = o;
  }
  openings_.resize(kept);
  for (uint32_t i = 0; i < slots.size(); ++i)
    if (slots[i].to != kNone) openings_.push_back({i / 3, slots[i].to, uint8_t(i % 3), slots[i].area});
}

/// Smallest first, each small part joins the neighbour with the widest opening; what grows past the limit
/// stops.
void Grid::Builder::mergeSmall() {
  const double least = kSmallest * grid.side_ * grid.side_ * grid.side_;
  std::vector<std::vector<std::pair<uint32_t, float>>> around(parts_.size());
  for (const Opening& o : openings_) {
    if (parts_[o.a].volume >= least && parts_[o.b].volume >= least) continue;
    around[o.a].emplace_back(o.b, o.area);
    around[o.b].emplace_back(o.a, o.area);
  }
  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < parts_.size(); ++i)
    if (parts_[i].volume < least) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return parts_[a].volume != parts_[b].volume ? parts_[a].volume < parts_[b].volume : a < b;
  });
  Unions unions(parts_.size());
  for (const uint32_t i : order) {
    const uint32_t root = unions.root(i);
    if (parts_[root].volume >= least) continue;
    uint32_t best = kNone;
    float widest = 0;
    for (const auto& [to, area] : around[i])
      if (unions.root(to) != root && area > widest) widest = area, best = unions.root(to);
    if (best == kNone) continue;
    const uint32_t joined = unions.join(root, best), gone = joined == root ? best : root;
    parts_[joined].volume += parts_[gone].volume;
    parts_[joined].moment += parts_[gone].moment;
    if (joined != root) std::swap(around[joined], around[root]);
    around[joined].insert(around[joined].end(), around[gone].begin(), around[gone].end());
  }
  cellOf_.resize(parts_.size());
  for (uint32_t i = 0; i < parts_.size(); ++i) cellOf_[i] = unions.root(i);
}

/// Cells in the order of their voxels, so that neighbours are near in memory.
void Grid::Builder::number() {
  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < parts_.size(); ++i)
    if (cellOf_[i] == i) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const size_t va = grid.voxelIndex(parts_[a].voxel), vb = grid.voxelIndex(parts_[b].voxel);
    return va != vb ? va < vb : a < b;
  });
  std::vector<uint32_t> numbers(parts_.size(), kNone);
  for (uint32_t n = 0; n < order.size(); ++n) {
    const Part& part = parts_[order[n]];
    numbers[order[n]] = n;
    grid.cells_.push_back({glm::vec3(part.moment / part.volume), float(part.volume)});
  }
  for (uint32_t& c : cellOf_) c = numbers[c];
  grid.voxelCell_.assign(grid.voxelCount(), kNone);
  for (uint32_t i = 0; i < parts_.size(); ++i) {
    uint32_t& at = grid.voxelCell_[grid.voxelIndex(parts_[i].voxel)];
    at = at == kNone || at == cellOf_[i] ? cellOf_[i] : kSeveral;
  }
  for (uint32_t s = 0; s < part_.size(); ++s) grid.segments_[s].cell = cellOf_[part_[s]];
}

void Grid::Builder::link() {
  const auto least = float(kNearest * grid.side_);
  std::vector<uint32_t> count(grid.cells_.size() + 1, 0);
  struct Pair {
    uint32_t a, b;
    float conductance;
  };
  std::vector<Pair> pairs;
  for (const Opening& o : openings_) {
    const uint32_t a = cellOf_[o.a], b = cellOf_[o.b];
    if (a == b) continue;
    const float distance =
        std::max(least, std::abs(grid.cells_[a].centroid[o.axis] - grid.cells_[b].centroid[o.axis]));
    pairs.push_back({a, b, o.area / distance});
    pairs.push_back({b, a, o.area / distance});
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& l, const Pair& r) {
    return l.a != r.a ? l.a < r.a : l.b != r.b ? l.b < r.b : l.conductance < r.conductance;
  });
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (i > 0 && pairs[i].a == pairs[i - 1].a && pairs[i].b == pairs[i - 1].b) {
      grid.links_.back().conductance += pairs[i].conductance;
      continue;
    }
    grid.links_.push_back({pairs[i].b, pairs[i].conductance});
    ++count[pairs[i].a + 1];
  }
  std::partial_sum(count.begin(), count.end(), count.begin());
  grid.firstLink_ = std::move(count);
}

}  // namespace lychnite::volume
