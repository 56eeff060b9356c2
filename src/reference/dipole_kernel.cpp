#include "reference/dipole_kernel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lychnite {
namespace {

constexpr size_t kLanes = 16;

double shortestCore(const Profile& profile) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int c = 0; c < 3; ++c)
    if (profile.coreLength()[c] > 0) shortest = std::min(shortest, profile.coreLength()[c]);
  return std::isfinite(shortest) ? shortest : 1.0;
}

float knot(int high) {
  return std::bit_cast<float>(uint32_t(high) << KernelTable::kShift);
}

/// Everything the inner loop reads. The sums of the lanes are kept apart, so that vector units of any width
/// add in the same order and give the same bits.
struct Pass {
  float ox, oy, oz, offset;
  int first, last;
  const float *v0, *v1, *v2, *s0, *s1, *s2;
  const float *x, *y, *z, *f0, *f1, *f2;
  float* sums;  ///< three times kLanes
};

inline void addTerm(const Pass& p, size_t i, size_t lane) {
  const float dx = p.x[i] - p.ox, dy = p.y[i] - p.oy, dz = p.z[i] - p.oz;
  const float t = dx * dx + dy * dy + dz * dz + p.offset;
  const int bits = std::bit_cast<int>(t);
  const int high = bits >> KernelTable::kShift;
  const float rest = t - std::bit_cast<float>(high << KernelTable::kShift);
  const int entry = std::min(high - p.first, p.last);
  p.sums[lane] += (p.v0[entry] + p.s0[entry] * rest) * p.f0[i];
  p.sums[kLanes + lane] += (p.v1[entry] + p.s1[entry] * rest) * p.f1[i];
  p.sums[2 * kLanes + lane] += (p.v2[entry] + p.s2[entry] * rest) * p.f2[i];
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define LYCHNITE_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define LYCHNITE_VECTOR_CLONES
#endif

LYCHNITE_VECTOR_CLONES void addBlocks(const Pass& pass, size_t begin, size_t end) {
  const Pass p = pass;
  for (size_t i = begin; i < end; i += kLanes)
#pragma GCC ivdep
    for (size_t lane = 0; lane < kLanes; ++lane) addTerm(p, i + lane, lane);
}

}  // namespace

double windowAt(double r, double radius) {
  const double x = radius > 0 ? std::min(1.0, (r / radius) * (r / radius)) : 1.0;
  return (1 - x) * (1 - x) * (1 + 2 * x);
}

KernelTable::KernelTable(const Profile& profile, double inner, double outer, double reach) {
  const double start = inner > 0 ? 0.2 * inner : 0.1 * shortestCore(profile);
  first_ = int(std::bit_cast<uint32_t>(float(start * start)) >> kShift);
  offset_ = knot(first_);
  const float end = float(reach * reach) * 1.01f + offset_;
  const int entries = int(std::bit_cast<uint32_t>(end) >> kShift) - first_ + 2;
  const auto at = [&](int entry) {
    const double r = std::sqrt(std::max(0.0, double(knot(first_ + entry)) - double(offset_)));
    const double outside = outer > 0 && std::isfinite(outer) ? windowAt(r, outer) : 1.0;
    const double share = outside - windowAt(r, inner);
    return share > 0 ? profile.Rd(r) * share : Rgb(0);
  };
  for (int c = 0; c < 3; ++c) {
    value_[c].resize(size_t(entries));
    slope_[c].resize(size_t(entries));
  }
  Rgb here = at(0);
  for (int i = 0; i < entries; ++i) {
    const Rgb next = at(i + 1);
    const double width = double(knot(first_ + i + 1)) - double(knot(first_ + i));
    for (int c = 0; c < 3; ++c) {
      value_[c][size_t(i)] = float(here[c]);
      slope_[c][size_t(i)] = float((next[c] - here[c]) / width);
    }
    here = next;
  }
}

void FluxPoints::reserve(size_t n) {
  for (std::vector<float>* list : {&x, &y, &z, &flux[0], &flux[1], &flux[2]}) list->reserve(n);
}

void FluxPoints::clear() {
  for (std::vector<float>* list : {&x, &y, &z, &flux[0], &flux[1], &flux[2]}) list->clear();
}

void FluxPoints::add(const glm::vec3& position, const glm::vec3& phi) {
  x.push_back(position.x);
  y.push_back(position.y);
  z.push_back(position.z);
  for (int c = 0; c < 3; ++c) flux[c].push_back(phi[c]);
}

void FluxPoints::append(const FluxPoints& other, size_t begin, size_t end) {
  const auto copy = [&](std::vector<float>& to, const std::vector<float>& from) {
    to.insert(to.end(), from.begin() + ptrdiff_t(begin), from.begin() + ptrdiff_t(end));
  };
  copy(x, other.x);
  copy(y, other.y);
  copy(z, other.z);
  for (int c = 0; c < 3; ++c) copy(flux[c], other.flux[c]);
}

Rgb sumKernel(const KernelTable& kernel, const glm::vec3& receiver, const FluxPoints& sources, size_t begin,
              size_t end) {
  constexpr size_t kChunk = 256 * kLanes;  // beyond that, float sums are handed over to doubles
  Rgb total(0);
  while (begin < end) {
    const size_t stop = std::min(end, begin + kChunk);
    const size_t whole = begin + (stop - begin) / kLanes * kLanes;
    float sums[3 * kLanes] = {};
    const Pass pass{receiver.x,
                    receiver.y,
                    receiver.z,
                    kernel.offset(),
                    kernel.first(),
                    kernel.last(),
                    kernel.value(0),
                    kernel.value(1),
                    kernel.value(2),
                    kernel.slope(0),
                    kernel.slope(1),
                    kernel.slope(2),
                    sources.x.data(),
                    sources.y.data(),
                    sources.z.data(),
                    sources.flux[0].data(),
                    sources.flux[1].data(),
                    sources.flux[2].data(),
                    sums};
    addBlocks(pass, begin, whole);
    for (size_t i = whole; i < stop; ++i) addTerm(pass, i, i - whole);
    for (size_t lane = 0; lane < kLanes; ++lane)
      total += Rgb(sums[lane], sums[kLanes + lane], sums[2 * kLanes + lane]);
    begin = stop;
  }
  return total;
}

}  // namespace lychnite
