#include "reference/walk_guide.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace lychnite {

namespace {

using Cell = WalkGuideSamples::Cell;

constexpr float kEnoughFans = 24;  // to judge a cell by itself
constexpr float kPrior = 4;        // fans of the usual kind that every cell is taken to have seen as well
constexpr float kMostKappa = 12;
constexpr float kEnoughPassing = 150;               // collisions
constexpr float kLeastRoot = 0.1f, kMostRoot = 10;  // of the usual one

void add(WalkGuideSamples::Start& sum, const WalkGuideSamples::Start& other) {
  sum.count += other.count;
  sum.squares += other.squares;
  sum.cost += other.cost;
}

void add(Cell& sum, const Cell& other) {
  sum.count += other.count;
  sum.squares += other.squares;
  sum.reaches += other.reaches;
  sum.light += other.light;
  sum.towards += other.towards;
  sum.splats += other.splats;
}

/// The cell, or the smallest cube of cells around it (on the grid of its size) that saw enough.
template <class T>
T judged(const std::vector<T>& cells, size_t cell, float enough = kEnoughFans) {
  constexpr size_t n = WalkGuideSamples::kCells;
  const size_t x = cell % n, y = cell / n % n, z = cell / (n * n);
  T sum;
  for (size_t side = 1; side <= n; side *= 2) {
    sum = T{};
    for (size_t k = z / side * side; k < z / side * side + side; ++k)
      for (size_t j = y / side * side; j < y / side * side + side; ++j)
        for (size_t i = x / side * side; i < x / side * side + side; ++i)
          add(sum, cells[(k * n + j) * n + i]);
    if (sum.count >= enough) break;
  }
  return sum;
}

/// Maximum-likelihood lobe (Banerjee et al. 2005 eq. 4.4).
WalkGuide::Lobe lobeOf(const Cell& cell) {
  const float length = glm::length(cell.towards);
  if (!(cell.light > 0 && length > 0)) return {};
  // Few splats agree by chance.
  const float r = std::min(length / cell.light, 0.99f) * cell.splats / (cell.splats + 2);
  return {cell.towards / length, std::min(r * (3 - r * r) / (1 - r * r), kMostKappa)};
}

}  // namespace

void WalkGuideSamples::merge(const WalkGuideSamples& other) {
  for (size_t i = 0; i < cells.size(); ++i) add(cells[i], other.cells[i]);
  for (size_t i = 0; i < starts.size(); ++i) add(starts[i], other.starts[i]);
  for (size_t i = 0; i < passing.size(); ++i) add(passing[i], other.passing[i]);
  commonSquares += other.commonSquares;
}

std::vector<float> WalkGuideSamples::startImportance() const {
  std::vector<float> importance(starts.size(), 1);
  double sum = 0, count = 0;
  for (size_t i = 0; i < starts.size(); ++i) {
    const Start start = judged(starts, i);
    importance[i] = start.cost > 0 ? std::sqrt(start.squares / start.cost) : 0;
    sum += double(starts[i].count) * double(importance[i]);
    count += double(starts[i].count);
  }
  // A part is left as it was, so that what the pilot missed is not missed for good.
  for (float& i : importance) i = sum > 0 ? 0.3f + 0.7f * float(double(i) * count / sum) : 1;
  return importance;
}

std::vector<float> WalkGuideSamples::idealWeights() const {
  std::vector<float> root(passing.size());
  for (size_t i = 0; i < root.size(); ++i) {
    const Start p = judged(passing, i, kEnoughPassing);
    root[i] = p.cost > 0 ? std::sqrt(p.squares / p.cost) : 0;
  }
  // Where photons start they should go on as they are.
  double sum = 0, count = 0;
  for (size_t i = 0; i < root.size(); ++i) {
    sum += double(starts[i].count) * double(root[i]);
    count += double(starts[i].count);
  }
  if (!(sum > 0)) return {};
  const auto usual = float(sum / count);
  for (float& r : root) r = usual / std::clamp(r, kLeastRoot * usual, kMostRoot * usual);
  return root;
}

glm::vec3 WalkGuide::Lobe::draw(float u, float phi) const {
  const float cosine = 1 + std::log(u + (1 - u) * std::exp(-2 * kappa)) / kappa;
  return transport::deflected(mean, std::fmax(cosine, -1.0f), phi);
}

float WalkGuide::Lobe::density(const glm::vec3& direction) const {
  const float norm = kappa / (2 * transport::kPi * (1 - std::exp(-2 * kappa)));
  return norm * std::exp(kappa * (glm::dot(direction, mean) - 1));
}

WalkGuide::WalkGuide(const WalkGuideSamples& samples, double photons, double work)
    : places_(samples.cells.size()), ideal_(samples.idealWeights()) {
  std::vector<double> root(places_.size());
  double largest = 0;
  Cell all;
  for (const Cell& cell : samples.cells) add(all, cell);
  const float usual = all.count > 0 ? all.squares / all.count : 0;
  for (size_t i = 0; i < root.size(); ++i) {
    const Cell cell = judged(samples.cells, i);
    places_[i].lobe = lobeOf(cell);
    root[i] = std::sqrt(double((cell.squares + kPrior * usual) / (cell.count + kPrior)));
    largest = std::max(largest, root[i]);
  }
  if (!(largest > 0)) return;
  // Per photon, variance = common + sum of reach root^2 / fans, cost = work + sum of reach fans, fans = root
  // / l.
  double bestProduct = 0, best = largest;
  for (double l = 2 * largest; l > 1e-4 * largest; l *= 0.8) {
    double variance = samples.commonSquares / photons, cost = work;
    for (size_t i = 0; i < root.size(); ++i) {
      const double fans = std::clamp(root[i] / l, double(kLeast), double(kMost));
      const double reach = double(samples.cells[i].reaches) / photons;
      variance += reach * root[i] * root[i] / fans;
      cost += reach * fans;
    }
    if (bestProduct == 0 || variance * cost < bestProduct) {
      bestProduct = variance * cost;
      best = l;
    }
  }
  for (size_t i = 0; i < root.size(); ++i) places_[i].chance = float(root[i] / best);
}

}  // namespace lychnite
