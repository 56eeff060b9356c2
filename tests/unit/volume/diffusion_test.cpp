#include "volume/diffusion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lychnite/mesh/builtin.h"

namespace lychnite::volume {
namespace {

TEST(Diffusion, LayerFollowsItsFormulas) {
  const Diffusion d(2.0, 0.3, 1.3);
  EXPECT_NEAR(d.D, (2 * 0.3 + 2.0) / (3 * 2.3 * 2.3), 1e-12);
  EXPECT_NEAR(d.k, std::sqrt(0.3 / d.D), 1e-12);
  const auto u = [&](double z) { return std::sinh(d.k * z) / d.k + d.zb * std::cosh(d.k * z); };
  const auto v = [&](double z) { return std::sinh(d.k * z) / d.k; };
  for (const double depth : {0.01, 0.5, 3.0}) {
    EXPECT_NEAR(d.perFluence(depth), 1 / u(depth), 1e-9);
    for (const double z : {0.0, 0.3 * depth, 0.9 * depth}) {
      EXPECT_NEAR(d.leaving(z, depth), v(depth - z) / u(depth), 1e-9);
      EXPECT_NEAR(d.staying(z, depth), u(z) / u(depth), 1e-9);
      EXPECT_LE(d.leaving(z, depth) + d.staying(z, depth), 1);
    }
    // u' = cosh + k zb sinh; what enters the layer from below leaves it or is absorbed.
    const double slope = std::cosh(d.k * depth) + d.k * d.zb * std::sinh(d.k * depth);
    EXPECT_NEAR(d.absorbedAbove(depth), (slope - 1) / u(depth), 1e-9);
  }
  EXPECT_LT(d.perFluence(1000), 1e-100);  // far below anything: no overflow
  EXPECT_FALSE(std::isnan(d.leaving(1, 1e5)));
}

TEST(Diffusion, BeamsThroughTheLayerAreIntegralsOfItsShares) {
  const Diffusion d(2.0, 0.3, 1.3);
  for (const double a : {0.5, d.k, 2.5, 40.0})
    for (const double depth : {0.05, 1.0, 8.0})
      for (const double end : {0.4 * depth, depth}) {
        constexpr int n = 20000;
        double leaving = 0, staying = 0;
        for (int i = 0; i < n; ++i) {
          const double z = end * (i + 0.5) / n, density = a * std::exp(-a * z) * end / n;
          leaving += density * d.leaving(z, depth);
          staying += density * d.staying(z, depth);
        }
        EXPECT_NEAR(d.beamLeaving(a, end, depth), leaving, 2e-5);
        EXPECT_NEAR(d.beamStaying(a, end, depth), staying, 2e-5);
      }
  EXPECT_FALSE(std::isnan(d.beamLeaving(3, 1e5, 1e5)));
  EXPECT_FALSE(std::isnan(d.beamStaying(3, 1e5, 1e5)));
}

TEST(Diffusion, NothingIsLostWithoutAbsorption) {
  const Diffusion d(5.0, 0.0, 1.5);
  for (const double z : {0.0, 0.2, 1.0}) EXPECT_NEAR(d.leaving(z, 1.5) + d.staying(z, 1.5), 1, 1e-5);
}

TEST(DiffusionSystem, BalancesSourcesAndSolvesFasterFromAGuess) {
  const LocalMesh mesh(*builtinMesh("knot"));
  const Grid grid(mesh, 32);
  const Surface surface(mesh, grid);
  const Coefficients medium{.sigma_s = Rgb(20, 50, 90), .sigma_a = Rgb(0, 1, 5), .eta = 1.4};
  const DiffusionSystem system(grid, surface, DiffusionRgb(medium));
  std::vector<Lanes> Q(grid.size(), Lanes{0, 0, 0, 0}), phi;
  for (size_t i = 0; i < Q.size(); i += 7) Q[i] = Lanes{1, 2, 3, 0};
  const auto report = system.solve(Q, phi, 1e-5);
  EXPECT_LT(report.residual, 1e-5);
  std::vector<Lanes> exits;
  system.exits(phi, exits);
  const Rgb absorbed = system.absorbed(phi);
  for (int c = 0; c < 3; ++c) {
    double in = 0, out = absorbed[c];
    for (const Lanes& q : Q) in += double(q[c]);
    for (const Lanes& e : exits) out += double(e[c]);
    EXPECT_NEAR(out / in, 1, 1e-3) << c;
  }
  for (Lanes& q : Q) q *= 1.01f;
  EXPECT_LT(system.solve(Q, phi, 1e-3).iterations, report.iterations / 2);
}

}  // namespace
}  // namespace lychnite::volume
