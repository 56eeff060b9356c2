#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/materials.h"
#include "lychnite/optics/profile.h"

namespace lychnite {
namespace {

TEST(Dipole, TailIntegralToFiveDigits) {
  for (const char* name : {"marble", "ketchup", "spectralon", "skin1"}) {
    const auto dipole = makeDipole(findMaterial(name, "").coefficients);
    for (int c = 0; c < 3; ++c) {
      const double z = dipole->coreLength()[c];
      // r = z sinh t spreads the steps over the core and the tail alike; composite Simpson.
      constexpr int kSteps = 4000;
      const double last = std::asinh(200.0), h = last / kSteps;
      double sum = 0;
      for (int i = 0; i <= kSteps; ++i) {
        const double t = i * h, r = z * std::sinh(t);
        const double weight = i == 0 || i == kSteps ? 1 : (i % 2 ? 4 : 2);
        sum += weight * dipole->Rd(r)[c] * 2 * std::numbers::pi * r * z * std::cosh(t);
      }
      sum *= h / 3;
      const double total = dipole->P(0)[c];
      EXPECT_NEAR(sum, total - dipole->P(200 * z)[c], 1e-5 * total) << name << " " << c;
    }
  }
}

TEST(Dipole, TotalsAreThoseOfJensensTable) {
  // The diffuse reflectance column of [J01]'s table (docs/physics.md, "Known answers"): printed to two
  // digits.
  struct Row {
    const char* name;
    Rgb reflectance;
  };
  const Row table[]{
      {"marble", {0.83, 0.79, 0.75}},    {"skin1", {0.44, 0.22, 0.13}},    {"skin2", {0.63, 0.44, 0.34}},
      {"wholemilk", {0.91, 0.88, 0.76}}, {"skimmilk", {0.81, 0.81, 0.69}}, {"ketchup", {0.16, 0.01, 0.00}},
      {"potato", {0.77, 0.62, 0.21}},    {"cream", {0.98, 0.90, 0.73}},    {"apple", {0.85, 0.84, 0.53}}};
  for (const Row& row : table) {
    const Rgb total = makeDipole(findMaterial(row.name, "").coefficients)->P(0);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(total[c], row.reflectance[c], 0.01) << row.name << " channel " << c;
  }
}

TEST(Dipole, CentreValueByHand) {
  // sigma_sp = 1, sigma_a = 0.1, eta = 1 (A = 1): zr = 1/1.1, zv = 7/3 zr.
  const auto dipole = makeDipole({.sigma_s = Rgb(1), .sigma_a = Rgb(0.1), .g = 0, .eta = 1});
  const double zr = 1 / 1.1, zv = zr * 7 / 3, s = std::sqrt(0.33), albedo = 1 / 1.1;
  const double expected =
      albedo / (4 * std::numbers::pi) *
      ((1 + s * zr) * std::exp(-s * zr) / (zr * zr) + (1 + s * zv) * std::exp(-s * zv) / (zv * zv));
  EXPECT_NEAR(dipole->Rd(0).x, expected, 1e-12);
  EXPECT_NEAR(dipole->P(0).x, albedo / 2 * (std::exp(-s * zr) + std::exp(-s * zv)), 1e-12);
}

TEST(Dipole, AnisotropyActsThroughTheReducedCoefficientsOnly) {
  const auto a = makeDipole({.sigma_s = Rgb(4), .sigma_a = Rgb(0.2), .g = 0.75, .eta = 1.3});
  const auto b = makeDipole({.sigma_s = Rgb(1), .sigma_a = Rgb(0.2), .g = 0, .eta = 1.3});
  for (double r : {0.0, 0.5, 5.0}) EXPECT_DOUBLE_EQ(a->Rd(r).x, b->Rd(r).x);
}

TEST(Dipole, NothingScatteredNothingComesBack) {
  const auto dipole = makeDipole({.sigma_s = Rgb(0), .sigma_a = Rgb(2), .g = 0, .eta = 1.3});
  EXPECT_EQ(dipole->Rd(0), Rgb(0));
  EXPECT_EQ(dipole->P(0), Rgb(0));
  const auto empty = makeDipole(Coefficients{});
  EXPECT_EQ(empty->Rd(0), Rgb(0));
  EXPECT_EQ(empty->P(1), Rgb(0));
}

TEST(Dipole, TailFallsLikeItsDecayAndAsACubeWithoutAbsorption) {
  const auto absorbing = makeDipole({.sigma_s = Rgb(1), .sigma_a = Rgb(0.1), .g = 0, .eta = 1.3});
  const double decay = absorbing->tailDecay().x;
  // Rd ~ sigma_tr (zr + zv) exp(-sigma_tr r) / r^2 far out.
  const double ratio = absorbing->Rd(101).x * 101 * 101 / (absorbing->Rd(100).x * 100 * 100);
  EXPECT_NEAR(std::log(ratio), -decay, 1e-3 * decay);
  const auto clear = makeDipole({.sigma_s = Rgb(1), .sigma_a = Rgb(0), .g = 0, .eta = 1.3});
  EXPECT_EQ(clear->tailDecay(), Rgb(0));
  EXPECT_NEAR(clear->Rd(2e4).x * 8, clear->Rd(1e4).x, 1e-4 * clear->Rd(1e4).x);
  EXPECT_NEAR(clear->P(2e4).x * 2, clear->P(1e4).x, 1e-4 * clear->P(1e4).x);
}

}  // namespace
}  // namespace lychnite
