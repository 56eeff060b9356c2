// The reference tests' questions with errors several times smaller: minutes, for the night.
#include <gtest/gtest.h>

#include "lychnite/mesh/builtin.h"
#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/materials.h"
#include "lychnite/reference/reference.h"
#include "lychnite/reference/slab.h"
#include "reference/reference/h_function.h"
#include "reference/reference/walk_scenes.h"

namespace lychnite {
namespace {

TEST(LongSlab, PublishedValues) {
  SlabSettings settings;
  settings.medium = {.sigma_s = Rgb(9), .sigma_a = Rgb(1), .g = 0.75, .eta = 1};
  settings.thickness = 0.2;
  settings.photons = 20'000'000;
  const SlabResult r = simulateSlab(settings);
  EXPECT_NEAR(r.diffuse_reflectance.value.y, 0.09739, kSigmas * r.diffuse_reflectance.standardError.y + 5e-6);
  EXPECT_NEAR(r.total_transmittance.value.y, 0.66096, kSigmas * r.total_transmittance.standardError.y + 5e-6);
  EXPECT_LT(r.diffuse_reflectance.standardError.y, 1e-4);
}

TEST(LongSlab, Chandrasekhar) {
  for (const double albedo : {0.5, 0.8, 0.9, 0.95, 0.99, 0.999}) {
    const HFunction H(albedo);
    for (const bool diffuse : {false, true}) {
      SlabSettings settings;
      settings.medium = {.sigma_s = Rgb(albedo), .sigma_a = Rgb(1 - albedo), .g = 0, .eta = 1};
      settings.diffuse = diffuse;
      settings.photons = 4'000'000;
      const SlabShare share = simulateSlab(settings).diffuse_reflectance;
      EXPECT_NEAR(share.value.y, diffuse ? H.diffuseAlbedo() : H.reflectance(1),
                  kSigmas * share.standardError.y)
          << albedo << (diffuse ? " diffuse" : " normal");
      EXPECT_LT(share.standardError.y, 6e-4);
    }
  }
}

TEST(LongWalk, SlabMeshMatchesTheSlabForEveryMaterial) {
  for (const char* name : {"skin1", "marble", "skimmilk", "wholemilk", "fig6"}) {
    const Coefficients& medium = findMaterial(name, "test").coefficients;
    SlabSettings slab;
    slab.medium = medium;
    slab.thickness = 1;
    slab.photons = 4'000'000;
    const SlabResult truth = simulateSlab(slab);
    const Rgb expected = truth.total_transmittance.value - truth.unscattered_transmittance.value;
    const auto [mean, error] = overSeeds(8, [&](uint64_t seed) {
      RenderSettings settings = walkSettings(24, 800);
      settings.aovs = {"radiosity"};
      settings.seed = seed;
      return middle(renderReference(slabScene(medium, 60, 1, false), settings), "radiosity");
    });
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(mean[c], expected[c],
                  kSigmas * (error[c] + truth.total_transmittance.standardError[c]) + 0.002)
          << name << ' ' << c;
  }
}

TEST(LongWalk, ConservesPowerOnEveryClosedModel) {
  for (const BuiltinModel& model : builtinModels()) {
    if (model.name == "disc") continue;
    const Coefficients medium{.sigma_s = Rgb(3), .sigma_a = Rgb(0), .g = 0.5, .eta = 1.5};
    const Image image =
        renderReference(sceneOf(translucent(builtinMesh(model.name), 20, medium)), walkSettings(64, 100));
    EXPECT_NEAR(share(image, "escaped").y + share(image, "lost").y + share(image, "ended").y, 1, 5e-5)
        << model.name;
    EXPECT_LT(share(image, "lost").y, 1e-3) << model.name;
  }
}

}  // namespace
}  // namespace lychnite
