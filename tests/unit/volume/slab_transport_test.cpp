#include "volume/slab_transport.h"

#include <gtest/gtest.h>

namespace lychnite::volume {
namespace {

TEST(SlabTransport, ReflectsAsChandrasekharAndGiovanelliSay) {
  // Normal incidence on a half-space, isotropic scattering: H functions (Chandrasekhar 1960).
  const double known[][2] = {{0.5, 0.115226}, {0.8, 0.285255}, {0.9, 0.414947}, {0.95, 0.535541}};
  for (const auto& [albedo, reflectance] : known)
    EXPECT_NEAR(SlabTransport::reflectance(albedo, 1, 1), reflectance, 0.002 * reflectance) << albedo;
  // Index 1.5, albedo .9: .26 with the .04 that the surface mirrors (Giovanelli 1955).
  EXPECT_NEAR(0.96 * SlabTransport::reflectance(0.9, 1.5, 1), 0.22, 0.0007);
}

TEST(SlabTransport, MakesDiffusionSendBackWhatTransportDoes) {
  for (const auto& [sigma_sp, sigma_a] : {std::pair(0.88, 0.17), {1.01, 0.48}, {0.18, 0.061}, {0.07, 0.97}}) {
    const Diffusion d(sigma_sp, sigma_a, 1.3);
    const SlabTransport slabs(d, 1.3);
    for (const double cosine : {1.0, 0.8, 0.65}) {
      double plain = 0, corrected = 0;  // sums over the beam's first collisions
      constexpr int n = 4000;
      for (int i = 0; i < n; ++i) {
        const double depth = -std::log(1 - (i + 0.5) / n) * cosine;  // mean free paths
        const double leaves = d.albedo_p * std::exp(-d.k * depth / d.sigma_tp) / (1 + d.k * d.zb) / n;
        plain += leaves;
        corrected += leaves * (1 + double(slabs.excess(100, float(depth))));
      }
      const double truth = SlabTransport::reflectance(d.albedo_p, 1.3, cosine);
      EXPECT_NEAR(corrected, truth, 0.005 * truth) << sigma_sp << " " << sigma_a << " " << cosine;
      EXPECT_GT(std::abs(plain - truth), 0.05 * truth) << "diffusion alone is wrong";
    }
  }
}

TEST(SlabTransport, ChangesNothingWhereNothingIsAbsorbed) {
  const SlabTransport some(Diffusion(1.01, 0.48, 1.3), 1.3);
  for (const double sigma_sp : {1e-6, 1e-5, 2.0}) {
    const SlabTransport none(Diffusion(sigma_sp, 0, 1.3), 1.3);
    for (const float thickness : {0.01f, 1.0f, 50.0f}) EXPECT_EQ(none.excess(thickness, 0.3f * thickness), 0);
  }
  // Nearly clear: no more than what is there to absorb.
  const SlabTransport clear(Diffusion(1e-6, 1e-7, 1.3), 1.3);
  for (const float thickness : {1e-6f, 1e-3f, 1.0f})
    EXPECT_LT(std::abs(clear.excess(thickness, 0.3f * thickness)), 0.5);
  EXPECT_NEAR(some.excess(0.01f, 0.005f), 0, 0.002);  // too thin to absorb
  EXPECT_LT(some.excess(50, 0.1f), -0.05);
  EXPECT_LT(some.excess(50, 1e6f), -0.02);
}

}  // namespace
}  // namespace lychnite::volume
