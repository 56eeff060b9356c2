#include "lychnite/reference/slab.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "lychnite/base/error.h"
#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/materials.h"
#include "reference/reference/h_function.h"

namespace lychnite {
namespace {

constexpr double kSigmas = 4;

/// Within four standard errors of the truth (plus what the published value was rounded by), with an error
/// small enough to mean something.
void expectShare(const SlabShare& share, double truth, double maxError, double rounding = 0) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(share.value[c], truth, kSigmas * share.standardError[c] + rounding) << "channel " << c;
    EXPECT_LE(share.standardError[c], maxError) << "channel " << c;
  }
}

SlabSettings slabOf(Rgb sigma_s, Rgb sigma_a, double g, double eta, double thickness, uint64_t photons) {
  SlabSettings settings;
  settings.medium = {.sigma_s = sigma_s, .sigma_a = sigma_a, .g = g, .eta = eta};
  settings.thickness = thickness;
  settings.photons = photons;
  return settings;
}

constexpr double kHalfSpace = std::numeric_limits<double>::infinity();

// van de Hulst 1980, table 35; used by MCML (Wang, Jacques & Zheng 1995, table 1).
TEST(Slab, VanDeHulst) {
  const SlabResult r = simulateSlab(slabOf(Rgb(9), Rgb(1), 0.75, 1, 0.2, 300'000));
  expectShare(r.diffuse_reflectance, 0.09739, 0.0008, 5e-6);
  expectShare(r.total_transmittance, 0.66096, 0.0012, 5e-6);
  EXPECT_NEAR(r.unscattered_transmittance.value.x, std::exp(-2.0), 1e-6);
}

// Giovanelli 1955, used by MCML (table 2): 0.2600 with the specular 0.04.
TEST(Slab, Giovanelli) {
  const SlabResult r = simulateSlab(slabOf(Rgb(9), Rgb(1), 0, 1.5, kHalfSpace, 300'000));
  EXPECT_NEAR(r.specular_reflectance.value.x, 0.04, 1e-6);
  expectShare(r.diffuse_reflectance, 0.2200, 0.0012, 5e-5);
}

TEST(Slab, ChandrasekharsTableIsOurs) {
  EXPECT_NEAR(HFunction(0.5).reflectance(1), 0.115226, 1e-6);
  EXPECT_NEAR(HFunction(0.5).diffuseAlbedo(), 0.146544, 1e-6);
  EXPECT_NEAR(HFunction(0.999).reflectance(1), 0.912845, 1e-6);
  EXPECT_NEAR(HFunction(0.999).diffuseAlbedo(), 0.929713, 1e-6);
}

class HalfSpace : public testing::TestWithParam<std::array<double, 3>> {};

// Three albedos are the three channels of one run, so the spectral weights are on trial as well.
TEST_P(HalfSpace, MatchesChandrasekhar) {
  const auto albedo = GetParam();
  const Rgb sigma_t(1.0, 1.7, 0.6);
  const Rgb a(albedo[0], albedo[1], albedo[2]);
  SlabSettings settings = slabOf(a * sigma_t, (1.0 - a) * sigma_t, 0, 1, kHalfSpace, 200'000);
  const SlabResult normal = simulateSlab(settings);
  settings.diffuse = true;
  settings.seed = 2;
  const SlabResult diffuse = simulateSlab(settings);
  for (int c = 0; c < 3; ++c) {
    const HFunction H(albedo[size_t(c)]);
    const SlabShare& n = normal.diffuse_reflectance;
    const SlabShare& d = diffuse.diffuse_reflectance;
    EXPECT_NEAR(n.value[c], H.reflectance(1), kSigmas * n.standardError[c]) << albedo[size_t(c)];
    EXPECT_NEAR(d.value[c], H.diffuseAlbedo(), kSigmas * d.standardError[c]) << albedo[size_t(c)];
    EXPECT_LT(n.standardError[c], 0.003);
    EXPECT_LT(d.standardError[c], 0.003);
  }
}
INSTANTIATE_TEST_SUITE_P(Albedos, HalfSpace,
                         testing::Values(std::array{0.5, 0.8, 0.9}, std::array{0.95, 0.99, 0.999}));

// Independent values for collimated normal incidence, good to 0.001.
struct LadderStep {
  const char* material;
  int channel;
  double mm, reflectance, transmittance;
};

TEST(Slab, SizeLadder) {
  constexpr LadderStep kLadder[] = {{"skin1", 0, 1, .2301, .6661},    {"skin1", 0, 3, .3737, .3626},
                                    {"skin1", 0, 10, .4302, .0543},   {"skin1", 0, 30, .4320, .0003},
                                    {"marble", 1, 1, .4913, .4500},   {"marble", 1, 3, .6654, .2390},
                                    {"marble", 1, 10, .7611, .0563},  {"skimmilk", 1, 1, .3609, .6141},
                                    {"skimmilk", 1, 3, .5894, .3678}, {"skimmilk", 1, 10, .7670, .1344}};
  for (const LadderStep& step : kLadder) {
    const Coefficients& m = findMaterial(step.material, "test").coefficients;
    const SlabResult r = simulateSlab(
        slabOf(Rgb(m.sigma_s[step.channel]), Rgb(m.sigma_a[step.channel]), 0, m.eta, step.mm, 600'000));
    SCOPED_TRACE(testing::Message() << step.material << ' ' << step.mm << " mm");
    expectShare(r.diffuse_reflectance, step.reflectance, 0.0007, 0.001);
    expectShare(r.total_transmittance, step.transmittance, 0.0007, 0.001);
  }
}

TEST(Slab, NothingAbsorbedAllComesOut) {
  for (const double g : {-0.5, 0.0, 0.99}) {
    const SlabResult r = simulateSlab(slabOf(Rgb(1, 3, 10), Rgb(0), g, 1.4, 2, 60'000));
    EXPECT_EQ(r.absorbed.value, Rgb(0));
    for (int c = 0; c < 3; ++c) {
      const double sum =
          r.diffuse_reflectance.value[c] + r.specular_reflectance.value[c] + r.total_transmittance.value[c];
      const double error =
          std::hypot(r.diffuse_reflectance.standardError[c], r.total_transmittance.standardError[c]);
      EXPECT_NEAR(sum, 1, kSigmas * error) << "g " << g << " channel " << c;
      EXPECT_LT(error, 0.01);
    }
  }
}

TEST(Slab, SharesAddUpWithAbsorption) {
  const SlabResult r = simulateSlab(slabOf(Rgb(1, 2, 4), Rgb(0.2, 0.1, 3), 0.3, 1.5, 1.5, 60'000));
  for (int c = 0; c < 3; ++c) {
    const double sum = r.diffuse_reflectance.value[c] + r.specular_reflectance.value[c] +
                       r.total_transmittance.value[c] + r.absorbed.value[c];
    EXPECT_NEAR(sum, 1,
                kSigmas * (r.diffuse_reflectance.standardError[c] + r.total_transmittance.standardError[c] +
                           r.absorbed.standardError[c]));
  }
}

TEST(Slab, EmptyMediumLetsAllThrough) {
  const SlabResult r = simulateSlab(slabOf(Rgb(0), Rgb(0), 0, 1, 5, 1000));
  EXPECT_EQ(r.total_transmittance.value, Rgb(1));
  EXPECT_EQ(r.diffuse_reflectance.value, Rgb(0));
  const SlabResult absorbing = simulateSlab(slabOf(Rgb(0), Rgb(2), 0, 1, 1, 1000));
  EXPECT_NEAR(absorbing.unscattered_transmittance.value.y, std::exp(-2.0), 1e-6);
  EXPECT_EQ(absorbing.diffuse_reflectance.value, Rgb(0));
}

TEST(Slab, RingsAddUpToTheTotal) {
  SlabSettings settings = slabOf(Rgb(2), Rgb(0.5), 0.2, 1.0, 3, 60'000);
  for (int i = 0; i <= 400; ++i) settings.ringEdges.push_back(0.1 * i);
  const SlabResult r = simulateSlab(settings);
  Rgb reflected(0), once(0), transmitted(0);
  for (size_t i = 0; i < r.radialReflectance.size(); ++i) {
    const double area = std::numbers::pi * 0.01 * double(2 * i + 1);
    reflected += r.radialReflectance[i].value * area;
    once += r.radialReflectanceOnce[i].value * area;
    transmitted += r.radialTransmittance[i].value * area;
  }
  EXPECT_NEAR(once.y, r.reflectance_once.value.y, 1e-4);
  EXPECT_GT(once.y, 0.1 * reflected.y);
  EXPECT_LT(once.y, 0.9 * reflected.y);
  EXPECT_NEAR(reflected.y, r.diffuse_reflectance.value.y, 1e-4);
  EXPECT_NEAR(transmitted.y, r.total_transmittance.value.y - r.unscattered_transmittance.value.y, 1e-4);
}

TEST(Slab, ThreadsDoNotChangeTheResult) {
  SlabSettings settings = slabOf(Rgb(2), Rgb(0.5), 0.2, 1.3, 3, 20'000);
  settings.threads = 1;
  const SlabResult one = simulateSlab(settings);
  settings.threads = 2;
  EXPECT_EQ(one.diffuse_reflectance.value, simulateSlab(settings).diffuse_reflectance.value);
}

TEST(Slab, HalvingThePhotonsDoublesTheVariance) {
  SlabSettings settings = slabOf(Rgb(2), Rgb(0.1), 0, 1.3, 3, 800'000);
  const double full = simulateSlab(settings).diffuse_reflectance.standardError.x;
  settings.photons /= 2;
  settings.seed = 5;
  const double half = simulateSlab(settings).diffuse_reflectance.standardError.x;
  // 390 and 195 blocks know their variance to 7 and 10 %.
  EXPECT_NEAR(half * half / (full * full), 2, 2 * kSigmas * std::hypot(0.07, 0.10));
}

TEST(Slab, RefusesBadSettings) {
  const SlabSettings good = slabOf(Rgb(1), Rgb(1), 0, 1.3, 1, 10);
  const auto refused = [&](auto change) {
    SlabSettings bad = good;
    change(bad);
    EXPECT_THROW(simulateSlab(bad), Error);
  };
  refused([](SlabSettings& s) { s.thickness = 0; });
  refused([](SlabSettings& s) { s.thickness = std::nan(""); });
  refused([](SlabSettings& s) { s.incidenceDegrees = 90; });
  refused([](SlabSettings& s) { s.photons = 0; });
  refused([](SlabSettings& s) { s.medium.eta = 0.9; });
  refused([](SlabSettings& s) { s.ringEdges = {1, 1}; });
  refused([](SlabSettings& s) { s.ringEdges = {1}; });
}

}  // namespace
}  // namespace lychnite
