#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "lychnite/base/error.h"
#include "lychnite/mesh/builtin.h"
#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/phase.h"
#include "lychnite/reference/reference.h"
#include "lychnite/reference/slab.h"
#include "reference/reference/walk_scenes.h"

namespace lychnite {
namespace {

TEST(Walk, NothingAbsorbedAllComesOut) {
  const Coefficients medium{.sigma_s = Rgb(1), .sigma_a = Rgb(0), .g = 0.3, .eta = 1.4};
  const Image image =
      renderReference(sceneOf(translucent(builtinMesh("figurine"), 20, medium)), walkSettings(32, 20));
  const Rgb escaped = share(image, "escaped"), lost = share(image, "lost"), ended = share(image, "ended");
  // Every photon carries its weight out or is lost, but for what roulette took and gave: no statistics, only
  // rounding.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(escaped[c] + lost[c] + ended[c], 1, 2e-5);
  EXPECT_NEAR(ended.x, 0, 0.03);
  EXPECT_LT(lost.x, 1e-3);
}

TEST(Walk, ChannelsShareOnePathWithoutBias) {
  const Coefficients medium{.sigma_s = Rgb(0.5, 1, 2), .sigma_a = Rgb(0.05, 0, 0.2), .g = 0, .eta = 1.3};
  const auto [together, togetherError] = overSeeds(8, [&](uint64_t seed) {
    RenderSettings settings = walkSettings(16, 20);
    settings.seed = seed;
    return share(renderReference(sceneOf(translucent(builtinMesh("sphere"), 8, medium)), settings),
                 "absorbed");
  });
  for (int c = 0; c < 3; ++c) {
    const Coefficients one{
        .sigma_s = Rgb(medium.sigma_s[c]), .sigma_a = Rgb(medium.sigma_a[c]), .g = 0, .eta = 1.3};
    const auto [alone, aloneError] = overSeeds(8, [&](uint64_t seed) {
      RenderSettings settings = walkSettings(16, 20);
      settings.seed = 100 + seed;
      return share(renderReference(sceneOf(translucent(builtinMesh("sphere"), 8, one)), settings),
                   "absorbed");
    });
    const double error = std::hypot(togetherError[c], aloneError.x);
    EXPECT_NEAR(together[c], alone.x, kSigmas * error) << "channel " << c;
    EXPECT_LE(error, 0.006);
  }
}

/// Boxes side by side, each lit by the share of one of the even steps that photons start in; every third one
/// is alike, so that a step's number tells how thick its box is.
std::shared_ptr<const Mesh> boxesInSteps() {
  constexpr int kSteps = 1024, kSide = 32;
  auto mesh = std::make_shared<Mesh>();
  for (int i = 0; i < kSteps; ++i) {
    const float thickness[3] = {0.05f, 0.2f, 1};
    const auto box = boxMesh(glm::vec3(0.4f, 0.4f, thickness[i % 3]));
    const auto first = uint32_t(mesh->positions.size());
    for (const glm::vec3& p : box->positions)
      mesh->positions.push_back(p + glm::vec3(float(i % kSide), float(i / kSide), 0));
    mesh->normals.insert(mesh->normals.end(), box->normals.begin(), box->normals.end());
    for (const glm::uvec3& t : box->triangles) mesh->triangles.push_back(t + first);
  }
  return mesh;
}

TEST(Walk, EveryPartOfTheLightServesAllChannels) {
  const Coefficients medium{.sigma_s = Rgb(4, 1, 0.2), .sigma_a = Rgb(0.5, 1, 2), .g = 0, .eta = 1.3};
  const auto mesh = boxesInSteps();
  const auto absorbed = [&](const Coefficients& coefficients, uint64_t seed) {
    Scene scene = sceneOf(translucent(mesh, 32, coefficients));
    scene.lights = {ParallelLight{.azimuth = 0, .elevation = 0}};
    // Away from it all, so that photons start evenly: nothing tells them where it pays.
    scene.camera = PinholeCamera{.position = {0, 0, 300}, .target = {0, 0, 600}, .fov = 10};
    RenderSettings settings = walkSettings(16, 25);
    settings.seed = seed;
    return share(renderReference(scene, settings), "absorbed");
  };
  const auto [together, togetherError] = overSeeds(4, [&](uint64_t seed) { return absorbed(medium, seed); });
  const Coefficients red{
      .sigma_s = Rgb(medium.sigma_s.x), .sigma_a = Rgb(medium.sigma_a.x), .g = 0, .eta = 1.3};
  const auto [alone, aloneError] = overSeeds(4, [&](uint64_t seed) { return absorbed(red, 100 + seed); });
  EXPECT_NEAR(together.x, alone.x, 0.02);  // .07 less if every step had one channel
  EXPECT_LE(std::hypot(togetherError.x, aloneError.x), 0.005);
}

/// Uniform light from everywhere, as many parallel lights: inside, the radiance is eta^2 L0 everywhere, so as
/// much leaves as enters at every point: B = pi L0 C(eta), but for the unscattered part (2 / (optical
/// diameter)^2 of it).
class WhiteFurnace : public testing::TestWithParam<double> {};

TEST_P(WhiteFurnace, LeavesAsMuchAsEnters) {
  const double eta = GetParam();
  const Coefficients medium{.sigma_s = Rgb(4), .sigma_a = Rgb(0), .g = 0, .eta = eta};
  Scene scene = sceneOf(translucent(builtinMesh("sphere"), 10, medium));
  scene.lights.clear();
  constexpr int kLights = 64;
  for (int i = 0; i < kLights; ++i) {
    const double z = 1 - (2 * i + 1.0) / kLights;
    scene.lights.push_back(ParallelLight{.azimuth = 137.50776 * i,
                                         .elevation = std::asin(z) * 180 / std::numbers::pi,
                                         .irradiance = Rgb(4 * std::numbers::pi / kLights)});
  }
  const auto [mean, error] = overSeeds(6, [&](uint64_t seed) {
    RenderSettings settings = walkSettings(24, 60);
    settings.aovs = {"radiosity"};
    settings.seed = seed;
    return middle(renderReference(scene, settings), "radiosity", 0.5);
  });
  const double truth = std::numbers::pi * diffuseTransmittanceOutside(eta);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean[c] / truth, 1, kSigmas * error[c] / truth + 0.003);  // 64 lights are nearly uniform
    EXPECT_LT(error[c] / truth, 0.015);
  }
}
INSTANTIATE_TEST_SUITE_P(Indices, WhiteFurnace, testing::Values(1.0, 1.5));

TEST(Walk, SlabMeshMatchesTheSlab) {
  const Coefficients medium{.sigma_s = Rgb(2, 4, 8), .sigma_a = Rgb(0.1, 0.05, 0.4), .g = 0.4, .eta = 1.3};
  SlabSettings slab;
  slab.medium = medium;
  slab.thickness = 1;
  slab.photons = 600'000;
  const SlabResult truth = simulateSlab(slab);
  for (const bool litSide : {true, false}) {
    const auto [mean, error] = overSeeds(6, [&](uint64_t seed) {
      RenderSettings settings = walkSettings(24, 150);
      settings.aovs = {"radiosity"};
      settings.seed = seed;
      return middle(renderReference(slabScene(medium, 24, 1, litSide), settings), "radiosity");
    });
    // The slab's reflectance holds a little unscattered light mirrored by its bottom, which the walk does not
    // splat.
    const Rgb returned = truth.unscattered_transmittance.value * truth.unscattered_transmittance.value *
                         fresnelReflectance(1, 1.3);
    const Rgb expected = litSide ? truth.diffuse_reflectance.value - returned
                                 : truth.total_transmittance.value - truth.unscattered_transmittance.value;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(mean[c], expected[c], kSigmas * error[c] + 0.003) << (litSide ? "lit " : "far ") << c;
      EXPECT_LT(error[c], 0.006);
    }
  }
}

TEST(Walk, FirstOrderOfANearlyClearMediumGoesWithItsScattering) {
  Scene scene = sceneOf(translucent(boxMesh(glm::vec3(20, 20, 20)), 40, {}));
  scene.lights = {ParallelLight{.azimuth = 30, .elevation = 20}};
  RenderSettings settings = walkSettings(16, 16);
  settings.components = {.multiple = false, .single = true, .surface = false};
  // From 1e-5 to a hundredth of a free path through the box; what is lost on the way is at most the product.
  const auto over = [&](double sigma) {
    scene.objects[0].material.medium = {
        .sigma_s = Rgb(sigma, 2 * sigma, 4 * sigma), .sigma_a = Rgb(0), .eta = 1.4};
    return middle(renderReference(scene, settings), "") / (sigma * Rgb(1, 2, 4));
  };
  const Rgb least = over(2.5e-7);
  EXPECT_GT(least.x, 0);
  for (const double sigma : {2.5e-6, 2.5e-5, 6e-5})
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(over(sigma)[c] / least[c], 1, 0.002 + 240 * sigma) << sigma << " " << c;
}

TEST(Walk, FirstOrderIsExactOnAFlatSurface) {
  const Coefficients medium{.sigma_s = Rgb(1, 2, 4), .sigma_a = Rgb(0.5, 0.1, 1), .g = 0.5, .eta = 1.4};
  Scene scene = sceneOf(translucent(boxMesh(glm::vec3(20, 20, 20)), 40, medium));
  scene.lights = {ParallelLight{.azimuth = 50, .elevation = 0, .irradiance = Rgb(2)}};
  const double away = 30 * std::numbers::pi / 180;
  scene.camera = PinholeCamera{.position = glm::dvec3(-500 * std::sin(away), 0, 20 + 500 * std::cos(away)),
                               .target = {0, 0, 20},
                               .fov = 0.5};
  RenderSettings settings = walkSettings(16, 64);
  settings.components = {.multiple = false, .single = true, .surface = false};
  settings.aovs = {"stderr"};
  const Image image = renderReference(scene, settings);
  const double eta = medium.eta, cosI = std::cos(50 * std::numbers::pi / 180), cosO = std::cos(away);
  const glm::dvec3 normal(0, 0, 1);
  const glm::dvec3 in = *refract(-directionFromAngles(50, 0), normal, eta);
  const glm::dvec3 out = -*refract(-directionFromAngles(-30, 0), normal, eta);
  const double beam = fresnelTransmittance(cosI, eta) * cosI / -in.z;
  for (int c = 0; c < 3; ++c) {
    const double depth = 1 / (medium.sigma_t()[c] * (1 + out.z / -in.z));  // integral of both attenuations
    const double truth = 2 * beam * medium.sigma_s[c] * henyeyGreenstein(glm::dot(in, out), medium.g) *
                         depth * fresnelTransmittance(cosO, eta) / (eta * eta);
    EXPECT_NEAR(middle(image, "")[c] / truth, 1, 0.01) << c;
  }
}

TEST(Walk, ThreadsDoNotChangeThePicture) {
  const Scene scene = sceneOf(translucent(
      builtinMesh("knot"), 10, {.sigma_s = Rgb(1, 2, 3), .sigma_a = Rgb(0.01), .g = 0, .eta = 1.3}));
  RenderSettings settings = walkSettings(24, 30);
  settings.components.single = true;
  settings.threads = 1;
  const Image one = renderReference(scene, settings);
  settings.threads = 2;
  EXPECT_EQ(one.channel("G"), renderReference(scene, settings).channel("G"));
}

TEST(Walk, SizeAndCoefficientsScaleTogether) {
  const Coefficients medium{.sigma_s = Rgb(1, 2, 3), .sigma_a = Rgb(0.01), .g = 0, .eta = 1.3};
  const RenderSettings settings = walkSettings(16, 100);
  const Image small = renderReference(sceneOf(translucent(builtinMesh("sphere"), 8, medium)), settings);
  const Image large =
      renderReference(sceneOf(translucent(builtinMesh("sphere"), 800, medium.scaled(100))), settings);
  const Rgb a = middle(small, ""), b = middle(large, "");
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / b[c], 1, 0.02);
}

TEST(Walk, StandardErrorIsHonest) {
  const Scene scene = sceneOf(translucent(
      builtinMesh("sphere"), 10, {.sigma_s = Rgb(1, 2, 3), .sigma_a = Rgb(0.01), .g = 0, .eta = 1.3}));
  RenderSettings settings = walkSettings(32, 200);
  settings.aovs = {"stderr"};
  const Image a = renderReference(scene, settings);
  settings.seed = 2;
  const Image b = renderReference(scene, settings);
  double squares = 0, variances = 0;
  for (size_t i = 0; i < a.pixelCount(); ++i) {
    const glm::vec3 d = a.rgb(i) - b.rgb(i), ea = a.rgb(i, "stderr"), eb = b.rgb(i, "stderr");
    squares += double(glm::dot(d, d));
    variances += double(glm::dot(ea, ea) + glm::dot(eb, eb));
  }
  EXPECT_NEAR(squares / variances, 1, 0.15);  // some 500 pixels of three channels
  const auto squaredNoise = [&](double samples) {
    settings.samples = samples;
    double sum = 0;
    for (settings.seed = 1; settings.seed <= 4; ++settings.seed)
      sum += std::pow(std::strtod(renderReference(scene, settings).metadata.at("noise").c_str(), nullptr), 2);
    return sum;
  };
  EXPECT_NEAR(squaredNoise(100) / squaredNoise(200), 2, 0.3);  // one seed's is good to a tenth
}

TEST(Walk, GoesOnFromItsPicture) {
  const Scene scene = sceneOf(translucent(
      builtinMesh("sphere"), 10, {.sigma_s = Rgb(1, 2, 3), .sigma_a = Rgb(0.01), .g = 0, .eta = 1.3}));
  RenderSettings settings = walkSettings(32, 64);
  const Image half = renderReference(scene, settings, {}, {}, {.resume = nullptr, .keepState = true});
  settings.samples = 128;
  const Image resumed = renderReference(scene, settings, {}, {}, {.resume = &half, .keepState = false});
  EXPECT_EQ(resumed.metadata.at("photons"), "131072");
  const auto noise = [](const Image& image) {
    return std::strtod(image.metadata.at("noise").c_str(), nullptr);
  };
  EXPECT_NEAR(noise(half) / noise(resumed), std::sqrt(2.0), 0.15);
  // Half of the photons are the same, so the means differ by about the half's error over the root of two.
  const Rgb a = middle(half, "", 0.5), b = middle(resumed, "", 0.5);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / b[c], 1, 0.12);
  EXPECT_NE(a, b);
  EXPECT_FALSE(resumed.has("state.multiple.R"));
  EXPECT_THROW(renderReference(scene, settings, {}, {}, {.resume = &resumed, .keepState = false}), Error);
  Scene other = scene;
  other.objects[0].size = 11;
  EXPECT_THROW(renderReference(other, settings, {}, {}, {.resume = &half, .keepState = false}), Error);
}

TEST(Walk, InterruptedGivesWhatThereIs) {
  const Scene scene = sceneOf(
      translucent(builtinMesh("sphere"), 10, {.sigma_s = Rgb(2), .sigma_a = Rgb(0.01), .g = 0, .eta = 1.3}));
  int calls = 0;
  const Progress stopSoon([&](const Progress::Update&) { return ++calls < 3; });
  const Image image = renderReference(scene, walkSettings(64, 1000), stopSoon);
  EXPECT_EQ(image.metadata.at("interrupted"), "true");
  EXPECT_GT(middle(image, "", 0.5).y, 0);
}

TEST(Walk, OpaqueObjectsShade) {
  const Coefficients medium{.sigma_s = Rgb(2), .sigma_a = Rgb(0.01), .g = 0, .eta = 1.3};
  Scene scene = sceneOf(translucent(builtinMesh("sphere"), 10, medium));
  Object wall = translucent(boxMesh(glm::vec3(20, 20, 0.5f)), 40, medium);
  wall.material.opaque = true;
  wall.position = {0, 0, -12};
  scene.lights = {ParallelLight{.azimuth = 180, .elevation = 0}};
  const double lit = middle(renderReference(scene, walkSettings(24, 50)), "").y;
  scene.objects.push_back(wall);
  const Image shaded = renderReference(scene, walkSettings(24, 50));
  EXPECT_GT(lit, 0.01);
  EXPECT_EQ(middle(shaded, "").y, 0);
}

TEST(Walk, LightPassesFromPartToPart) {
  const Coefficients medium{.sigma_s = Rgb(2), .sigma_a = Rgb(0), .g = 0, .eta = 1.3};
  // The near sphere hides from the light behind the far one and is lit by it alone.
  Object far = translucent(builtinMesh("sphere"), 10, medium),
         near = translucent(builtinMesh("sphere"), 6, medium);
  far.position = {0, 0, -10};
  Scene scene = sceneOf(near);
  scene.objects.push_back(far);
  scene.lights = {ParallelLight{.azimuth = 180, .elevation = 0}};
  scene.camera = PinholeCamera{.position = {0, 0, 100}, .target = {0, 0, 0}, .fov = 3};
  const Image image = renderReference(scene, walkSettings(24, 300));
  EXPECT_GT(middle(image, "", 0.5).y, 5e-5);
  EXPECT_NEAR(share(image, "escaped").y + share(image, "lost").y + share(image, "ended").y, 1, 2e-5);
}

TEST(Walk, CopesWithOddMediaAndMeshes) {
  const auto render = [](const char* model, const Coefficients& medium, std::string* warnings) {
    const LogSink log = [&](LogLevel, std::string_view text) {
      if (warnings) *warnings += text;
    };
    RenderSettings settings = walkSettings(16, 10);
    settings.components = {};
    Scene scene = sceneOf(translucent(builtinMesh(model), 10, medium));
    scene.lights.push_back(ParallelLight{.azimuth = 10, .elevation = 60});
    return renderReference(scene, settings, {}, log);
  };
  const Coefficients usual{.sigma_s = Rgb(2), .sigma_a = Rgb(0.1), .g = 0, .eta = 1.3};
  std::string warnings;
  const Image open = render("disc", usual, &warnings);
  EXPECT_NE(warnings.find("not closed"), std::string::npos);
  EXPECT_GT(share(open, "lost").y, 0.5);
  const Image empty = render("sphere", {.sigma_s = Rgb(0), .sigma_a = Rgb(0), .g = 0, .eta = 1.3}, nullptr);
  EXPECT_NEAR(share(empty, "escaped").y, 1, 1e-3);
  const Image black = render("sphere", {.sigma_s = Rgb(0), .sigma_a = Rgb(5), .g = 0, .eta = 1.0}, nullptr);
  EXPECT_GT(share(black, "absorbed").y, 0.9);
  const Image forward =
      render("sphere", {.sigma_s = Rgb(50), .sigma_a = Rgb(0.01), .g = 0.99, .eta = 1.3}, nullptr);
  EXPECT_GT(middle(forward, "", 0.4).y, 0);
  const Image dense =
      render("sphere", {.sigma_s = Rgb(1000), .sigma_a = Rgb(0.01), .g = 0, .eta = 1.3}, nullptr);
  EXPECT_GT(share(dense, "escaped").y, 0.5);
}

TEST(Walk, TracesSomethingHoweverShortTheTime) {
  RenderSettings settings = walkSettings(24, 1);
  settings.timeLimit = 1e-6;
  const Image image =
      renderReference(sceneOf(translucent(builtinMesh("sphere"), 10,
                                          {.sigma_s = Rgb(1), .sigma_a = Rgb(0.1), .g = 0, .eta = 1.3})),
                      settings);
  EXPECT_GT(middle(image, "").x, 0);
}

TEST(Walk, RefusesRealTimeMethods) {
  RenderSettings settings = walkSettings(16, 1);
  settings.method = Method::kAdaptive;
  const Scene scene = sceneOf(translucent(builtinMesh("sphere"), 10, {.sigma_s = Rgb(1), .sigma_a = Rgb(0)}));
  EXPECT_THROW(renderReference(scene, settings), Error);
}

}  // namespace
}  // namespace lychnite
