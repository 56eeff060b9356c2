#include "volume/diffusion.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "lychnite/optics/fresnel.h"
#include "volume/interruptible.h"

namespace lychnite::volume {

namespace {

constexpr size_t kBlock = 2048;
constexpr int kMostIterations = 600;

template <class Body>
void inBlocks(size_t count, Body body) {
  const size_t blocks = (count + kBlock - 1) / kBlock;
  tbb::parallel_for(size_t(0), blocks,
                    [&](size_t b) { body(b, b * kBlock, std::min(count, (b + 1) * kBlock)); });
}

Lanes total(const std::vector<Lanes>& parts) {
  Lanes sum{0, 0, 0, 0};
  for (const Lanes& p : parts) sum += p;
  return sum;
}

/// a / b, 0 where b is 0.
Lanes ratio(const Lanes& a, const Lanes& b) {
  Lanes r{0, 0, 0, 0};
  for (int c = 0; c < 3; ++c) r[c] = b[c] > 0 ? a[c] / b[c] : 0;
  return r;
}

}  // namespace

Diffusion::Diffusion(double sigma_sp, double absorption, double eta)
    : sigma_a(absorption), sigma_tp(std::max(1e-6, sigma_sp + absorption)), albedo_p(sigma_sp / sigma_tp) {
  D = (2 * absorption + sigma_sp) / (3 * sigma_tp * sigma_tp);
  const double c1 = internalMoment(eta, 1), c2 = internalMoment(eta, 2);
  zb = 2 * D * (1 + 3 * c2) / (1 - 2 * c1);
  k = std::max(1e-3, std::sqrt(sigma_a / D));
}

DiffusionRgb::DiffusionRgb(const Coefficients& local) {
  for (int c = 0; c < 3; ++c) channel[c] = Diffusion(local.sigma_sp()[c], local.sigma_a[c], local.eta);
}

DiffusionSystem::DiffusionSystem(const Grid& grid, const Surface& surface, const DiffusionRgb& medium)
    : grid_(grid), surface_(surface), medium_(medium), exit_(surface.samples().size()) {
  D_ = Lanes{1, 1, 1, 1};
  for (int c = 0; c < 3; ++c) D_[c] = float(medium.channel[c].D);
  const auto& samples = surface.samples();
  inBlocks(samples.size(), [&](size_t, size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      exit_[i] = Lanes{0, 0, 0, 0};
      if (samples[i].cell == Grid::kNone) continue;
      for (int c = 0; c < 3; ++c)
        exit_[i][c] = samples[i].area * float(medium.channel[c].perFluence(double(samples[i].depth)));
    }
  });
  findAbsorption();
  diagonal_ = absorption_;
  for (size_t i = 0; i < grid.size(); ++i) {
    float links = 0;
    for (auto* link = grid.linksBegin(i); link != grid.linksEnd(i); ++link) links += link->conductance;
    diagonal_[i] += Lanes{links, links, links, 1};
  }
  for (size_t i = 0; i < samples.size(); ++i)
    if (samples[i].cell != Grid::kNone) diagonal_[samples[i].cell] += exit_[i];
  // A cell of no links, no absorption and no surface has no light either.
  for (Lanes& d : diagonal_)
    for (int c = 0; c < 3; ++c) d[c] = std::max(d[c], 1e-20f);
}

/// In the layers between the surface and a cell's centroid as on a plane, elsewhere by the centroid's
/// fluence.
void DiffusionSystem::findAbsorption() {
  std::vector<float> layers(grid_.size(), 0);
  for (const auto& s : surface_.samples())
    if (s.cell != Grid::kNone) layers[s.cell] += s.area * s.depth;
  absorption_.assign(grid_.size(), Lanes{0, 0, 0, 0});
  for (const auto& s : surface_.samples()) {
    if (s.cell == Grid::kNone) continue;
    const float share = std::min(1.0f, grid_.cell(s.cell).volume / layers[s.cell]);
    for (int c = 0; c < 3; ++c)
      absorption_[s.cell][c] += share * s.area * float(medium_.channel[c].absorbedAbove(double(s.depth)));
  }
  for (size_t i = 0; i < grid_.size(); ++i) {
    const float rest = std::max(0.0f, grid_.cell(i).volume - layers[i]);
    for (int c = 0; c < 3; ++c)
      absorption_[i][c] += float(medium_.channel[c].sigma_a / medium_.channel[c].D) * rest;
  }
}

/// y = A x; `dots` gets x.y of each block.
void DiffusionSystem::multiply(const std::vector<Lanes>& x, std::vector<Lanes>& y,
                               std::vector<Lanes>& dots) const {
  inBlocks(x.size(), [&](size_t b, size_t first, size_t last) {
    Lanes dot{0, 0, 0, 0};
    for (size_t i = first; i < last; ++i) {
      Lanes sum = diagonal_[i] * x[i];
      for (auto* link = grid_.linksBegin(i); link != grid_.linksEnd(i); ++link)
        sum -= link->conductance * x[link->to];
      y[i] = sum;
      dot += sum * x[i];
    }
    dots[b] = dot;
  });
}

DiffusionSystem::Report DiffusionSystem::solve(const std::vector<Lanes>& Q, std::vector<Lanes>& phi,
                                               double tolerance) const {
  const size_t n = grid_.size(), blocks = (n + kBlock - 1) / kBlock;
  Report report;
  if (phi.size() != n) phi.assign(n, Lanes{0, 0, 0, 0});
  std::vector<Lanes> r(n), p(n), Ap(n), parts(blocks), more(blocks);
  multiply(phi, Ap, parts);
  inBlocks(n, [&](size_t b, size_t first, size_t last) {
    Lanes rz{0, 0, 0, 0}, qz{0, 0, 0, 0};
    for (size_t i = first; i < last; ++i) {
      const Lanes q = Q[i] / D_;
      r[i] = q - Ap[i];
      p[i] = r[i] / diagonal_[i];
      rz += r[i] * p[i];
      qz += q * q / diagonal_[i];
    }
    parts[b] = rz;
    more[b] = qz;
  });
  // Residuals are measured by the norm that the preconditioner gives, which weighs cells alike.
  Lanes rz = total(parts);
  const Lanes qz = total(more);
  const auto relative = [&] {
    double worst = 0;
    for (int c = 0; c < 3; ++c)
      if (qz[c] > 0) worst = std::max(worst, std::sqrt(double(rz[c]) / double(qz[c])));
    return worst;
  };
  for (; report.iterations < kMostIterations && relative() > tolerance; ++report.iterations) {
    Interruptible::check();
    multiply(p, Ap, parts);
    const Lanes alpha = ratio(rz, total(parts));
    inBlocks(n, [&](size_t b, size_t first, size_t last) {
      Lanes dot{0, 0, 0, 0};
      for (size_t i = first; i < last; ++i) {
        phi[i] += alpha * p[i];
        r[i] -= alpha * Ap[i];
        dot += r[i] * r[i] / diagonal_[i];
      }
      parts[b] = dot;
    });
    const Lanes next = total(parts), beta = ratio(next, rz);
    rz = next;
    inBlocks(n, [&](size_t, size_t first, size_t last) {
      for (size_t i = first; i < last; ++i) p[i] = r[i] / diagonal_[i] + beta * p[i];
    });
  }
  report.residual = relative();
  return report;
}

void DiffusionSystem::exits(const std::vector<Lanes>& phi, std::vector<Lanes>& nodes) const {
  nodes.assign(surface_.nodes().size(), Lanes{0, 0, 0, 0});
  const auto& samples = surface_.samples();
  for (size_t i = 0; i < samples.size(); ++i)
    if (samples[i].cell != Grid::kNone) nodes[samples[i].node] += exit_[i] * D_ * phi[samples[i].cell];
}

void DiffusionSystem::sourcesOfExits(const std::vector<Lanes>& weights, std::vector<Lanes>& Q) const {
  Q.assign(grid_.size(), Lanes{0, 0, 0, 0});
  const auto& samples = surface_.samples();
  for (size_t i = 0; i < samples.size(); ++i)
    if (samples[i].cell != Grid::kNone) Q[samples[i].cell] += exit_[i] * D_ * weights[samples[i].node];
}

Rgb DiffusionSystem::absorbed(const std::vector<Lanes>& phi) const {
  Rgb sum(0);
  for (size_t i = 0; i < phi.size(); ++i)
    for (int c = 0; c < 3; ++c) sum[c] += double(absorption_[i][c] * D_[c] * phi[i][c]);
  return sum;
}

}  // namespace lychnite::volume
