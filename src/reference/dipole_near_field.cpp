#include "reference/dipole_near_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "reference/dipole_kernel.h"
#include "reference/surface_samples.h"

namespace lychnite {
namespace {

constexpr int kRings = 320;
constexpr int kPilotProbes = 32;
constexpr int kMostProbes = 2048;
constexpr size_t kNeighbours = 6;

double shortestCore(const Profile& profile, double otherwise) {
  double shortest = otherwise;
  for (int c = 0; c < 3; ++c)
    if (profile.coreLength()[c] > 0) shortest = std::min(shortest, profile.coreLength()[c]);
  return shortest;
}

/// A seed of its own for each receiver.
uint64_t streamOf(uint64_t seed, size_t receiver) {
  return seed * 0x100000000ull + receiver;
}

double fraction(double x) {
  return x - std::floor(x);
}

}  // namespace

std::vector<glm::vec3> positionsOf(const std::vector<RayHit>& hits) {
  std::vector<glm::vec3> positions;
  positions.reserve(hits.size());
  for (const RayHit& hit : hits) positions.push_back(hit.position);
  return positions;
}

NearKernel::NearKernel(const Profile& profile, double radius) : radius_(radius) {
  first_ = 1e-3 * shortestCore(profile, radius);
  inverseLogRatio_ = (kRings - 1) / std::log(radius / first_);
  rings_.resize(kRings);
  std::vector<Rgb> masses(kRings);
  for (int i = 0; i < kRings; ++i) {
    Ring& ring = rings_[size_t(i)];
    ring.begin = i ? first_ * std::exp((i - 1) / inverseLogRatio_) : 0;
    ring.end = i + 1 < kRings ? first_ * std::exp(i / inverseLogRatio_) : radius;
    const double middle = std::sqrt(0.5 * (ring.begin * ring.begin + ring.end * ring.end));
    masses[size_t(i)] = (profile.P(ring.begin) - profile.P(ring.end)) * windowAt(middle, radius);
    mass_ += masses[size_t(i)];
  }
  const int lit = int(mass_.x > 0) + int(mass_.y > 0) + int(mass_.z > 0);
  double cumulative = 0;
  for (int i = 0; i < kRings; ++i) {
    Ring& ring = rings_[size_t(i)];
    const double area = std::numbers::pi * (ring.end * ring.end - ring.begin * ring.begin);
    double share = 0;
    for (int c = 0; c < 3; ++c)
      if (mass_[c] > 0) share += masses[size_t(i)][c] / (mass_[c] * lit);
    ring.kernel = masses[size_t(i)] / area;
    ring.density = share / area;
    cumulative += share;
    ring.cumulative = cumulative;
  }
}

size_t NearKernel::ringOf(double r) const {
  if (r <= first_) return 0;
  return std::min(size_t(kRings - 1), size_t(std::log(r / first_) * inverseLogRatio_) + 1);
}

double NearKernel::sampleRadius(double u) const {
  const double target = u * rings_.back().cumulative;
  const auto ring = std::lower_bound(rings_.begin(), rings_.end() - 1, target,
                                     [](const Ring& a, double value) { return a.cumulative < value; });
  const double before = ring == rings_.begin() ? 0 : (ring - 1)->cumulative;
  const double part = std::clamp((target - before) / std::max(ring->cumulative - before, 1e-300), 0.0, 1.0);
  return std::sqrt(ring->begin * ring->begin + part * (ring->end * ring->end - ring->begin * ring->begin));
}

/// The receiver, the three directions that probes run along, and how many run along each.
struct NearField::Frame {
  glm::dvec3 origin{0};
  std::array<glm::dvec3, 3> axis;
  std::array<int, 3> probes;
};

/// Mean and spread of the probes' terms.
class NearSum {
 public:
  void begin() { term_ = Rgb(0); }
  void add(const Rgb& value) { term_ += value; }
  void end() {
    sum_ += term_;
    squares_ += term_ * term_;
    ++count_;
  }
  NearEstimate finish(const Rgb& known) const {
    const Rgb variance = squares_ - sum_ * sum_ / double(count_);
    return {.radiosity = known + sum_,
            .spread = std::sqrt(std::max(0.0, (variance.x + variance.y + variance.z) / 3) * count_)};
  }

 private:
  Rgb term_{0}, sum_{0}, squares_{0};
  int count_ = 0;
};

NearField::NearField(const RayScene& scene, int object, const Profile& profile, double radius, int light)
    : scene_(scene),
      object_(object),
      light_(light),
      eta_(scene.medium(object).eta),
      kernel_(profile, radius) {}

/// What a hit by a probe along `axis` adds: kernel * irradiance over the density of that axis' probes per
/// area, times its weight against the other axes' by the power heuristic (Veach & Guibas 1995).
Rgb NearField::hitTerm(const Frame& frame, size_t axis, const RayHit& hit) const {
  const glm::dvec3 d = glm::dvec3(hit.position) - frame.origin;
  const double r = glm::length(d);
  if (r >= kernel_.radius()) return Rgb(0);
  double own = 0, squares = 0;
  for (size_t a = 0; a < 3; ++a) {
    const double along = glm::dot(d, frame.axis[a]);
    const double across = std::sqrt(std::max(0.0, r * r - along * along));
    const double density =
        frame.probes[a] * kernel_.density(across) * std::abs(glm::dot(glm::dvec3(hit.normal), frame.axis[a]));
    squares += density * density;
    if (a == axis) own = density;
  }
  if (squares <= 0) return Rgb(0);
  const Rgb entering = enteringIrradiance(scene_, eta_, {hit.position, hit.normal}, light_);
  return kernel_.kernel(r) * entering * (own / squares);
}

void NearField::addHits(const Frame& frame, int axis, const glm::vec3& offset, NearSum& sum) const {
  const glm::dvec3 d(offset);
  const double half = std::sqrt(std::max(0.0, kernel_.radius() * kernel_.radius() - glm::dot(d, d)));
  const glm::vec3 down(-frame.axis[size_t(axis)]);
  glm::vec3 from(frame.origin + d + frame.axis[size_t(axis)] * half);
  float left = float(2 * half);
  // A surface crossed more often than this within one radius is not resolved by the picture either.
  for (int crossing = 0; crossing < 64 && left > 0; ++crossing) {
    const RayHit hit = scene_.nearest(from, down, left);
    if (!hit) return;
    if (hit.object == object_) sum.add(hitTerm(frame, size_t(axis), hit));
    from = offPoint(hit, down);
    left -= hit.distance + RayScene::kOffset;
  }
}

NearEstimate NearField::estimate(const RayHit& at, int probes, uint64_t seed) const {
  const glm::dvec3 n(at.normal);
  const glm::dvec3 helper = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 t = glm::normalize(glm::cross(n, helper));
  const int side = std::max(1, probes / 16);
  const Frame frame{.origin = at.position,
                    .axis = {n, t, glm::cross(n, t)},
                    .probes = {std::max(2, probes - 2 * side), side, side}};
  const Rgb here = enteringIrradiance(scene_, eta_, {at.position, at.normal}, light_);
  NearSum sum;
  for (int a = 0; a < 3; ++a) {
    const int count = frame.probes[size_t(a)];
    const double shift = uniformAt(seed, uint64_t(2 * a)), turn = uniformAt(seed, uint64_t(2 * a + 1));
    for (int i = 0; i < count; ++i) {
      const double r = kernel_.sampleRadius(fraction((i + 0.5) / count + shift));
      const double phi = 2 * std::numbers::pi * fraction(i / std::numbers::phi + turn);
      const glm::dvec3& u = frame.axis[size_t((a + 1) % 3)];
      const glm::dvec3& v = frame.axis[size_t((a + 2) % 3)];
      sum.begin();
      addHits(frame, a, glm::vec3(r * (std::cos(phi) * u + std::sin(phi) * v)), sum);
      if (a == 0 && kernel_.density(r) > 0) sum.add(-kernel_.kernel(r) * here / (count * kernel_.density(r)));
      sum.end();
    }
  }
  return sum.finish(kernel_.mass() * here);
}

std::vector<int> NearField::planProbes(const std::vector<RayHit>& receivers, const PointGroups& groups,
                                       double noise, uint64_t seed) const {
  std::vector<NearEstimate> pilot(receivers.size());
  tbb::parallel_for(size_t(0), pilot.size(),
                    [&](size_t i) { pilot[i] = estimate(receivers[i], kPilotProbes, streamOf(seed, i)); });
  double mean = 0;
  for (const NearEstimate& p : pilot)
    mean += (p.radiosity.x + p.radiosity.y + p.radiosity.z) / (3.0 * double(pilot.size()));
  std::vector<int> probes(receivers.size(), kPilotProbes);
  if (mean <= 0) return probes;
  for (size_t place = 0; place < probes.size(); ++place) {
    // A pilot may miss a narrow light; its neighbours along the curve will not all.
    double spread = 0;
    const size_t end = std::min(probes.size(), place + kNeighbours + 1);
    for (size_t i = place - std::min(place, kNeighbours); i < end; ++i)
      spread = std::max(spread, pilot[groups.order[i]].spread);
    // The lattice's error falls about as n^-3/4.
    const double wanted = kPilotProbes + std::pow(spread / (noise * mean), 4.0 / 3.0);
    probes[groups.order[place]] = int(std::min<double>(kMostProbes, wanted));
  }
  return probes;
}

void NearField::add(const std::vector<RayHit>& receivers, const PointGroups& groups,
                    const std::vector<int>& probes, int refine, uint64_t seed, const Tick& tick,
                    std::vector<Rgb>& sums) const {
  forGroups(groups, tick, [&](const PointGroups::Group& group) {
    for (uint32_t i = group.begin; i < group.end; ++i) {
      const uint32_t r = groups.order[i];
      sums[r] += estimate(receivers[r], probes[r] * refine, streamOf(seed, r)).radiosity;
    }
  });
}

}  // namespace lychnite
