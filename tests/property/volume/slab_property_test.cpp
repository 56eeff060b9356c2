#include <gtest/gtest.h>

#include "lychnite/mesh/load.h"
#include "lychnite/optics/materials.h"
#include "lychnite/reference/slab.h"
#include "lychnite/volume/volume.h"

namespace lychnite {
namespace {

/// A box of 1 x 1 x thickness, its large faces cut into a raster so that their middles are vertices.
std::shared_ptr<const Mesh> wideSlab(double thickness) {
  Mesh mesh;
  constexpr int n = 16;
  const auto half = float(thickness / 2);
  const auto face = [&](float z, bool up) {
    const auto first = uint32_t(mesh.positions.size());
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) mesh.positions.emplace_back(float(i) / n - 0.5f, float(j) / n - 0.5f, z);
    for (uint32_t j = 0; j < n; ++j)
      for (uint32_t i = 0; i < n; ++i) {
        const uint32_t a = first + j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
        if (up)
          mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
        else
          mesh.triangles.insert(mesh.triangles.end(), {{a, d, b}, {a, c, d}});
      }
  };
  face(half, true);
  face(-half, false);
  const auto top = [&](int i, int j) { return uint32_t(j * (n + 1) + i); };
  const auto bottom = [&](int i, int j) { return uint32_t((n + 1) * (n + 1) + j * (n + 1) + i); };
  const auto wall = [&](int i0, int j0, int i1, int j1) {
    mesh.triangles.push_back({bottom(i0, j0), bottom(i1, j1), top(i1, j1)});
    mesh.triangles.push_back({bottom(i0, j0), top(i1, j1), top(i0, j0)});
  };
  for (int k = 0; k < n; ++k) {
    wall(k, 0, k + 1, 0);
    wall(n, k, n, k + 1);
    wall(n - k, n, n - k - 1, n);
    wall(0, n - k, 0, n - k - 1);
  }
  return repairMesh(std::move(mesh), "slab").mesh;
}

/// Radiosity at the middle of the large faces over the irradiance.
struct Shares {
  Rgb reflected, transmitted;
};

Shares middleOf(VolumeSolver& solver, const Mesh& mesh) {
  const auto radiosity = solver.vertexRadiosity(0, VolumeSolver::Orders::kAll);
  Shares shares{Rgb(0), Rgb(0)};
  double top = 0, bottom = 0;
  for (size_t i = 0; i < radiosity.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    if (std::abs(p.x) > 0.2f || std::abs(p.y) > 0.2f) continue;
    (p.z > 0 ? shares.reflected : shares.transmitted) += Rgb(radiosity[i]);
    (p.z > 0 ? top : bottom) += 1;
  }
  shares.reflected /= top;
  shares.transmitted /= bottom;
  return shares;
}

/// Material, g (with equal sigma_sp), thickness in mm.
class SlabLadder : public testing::TestWithParam<std::tuple<const char*, double, double>> {};

TEST_P(SlabLadder, ReflectsAndTransmitsAsTransportSays) {
  const auto [material, g, thickness] = GetParam();
  constexpr double kShape = 0.01;  // thickness over width: less than a cell, so that the walls are far
  Scene scene;
  scene.objects.push_back({.mesh = wideSlab(kShape), .size = thickness / kShape});
  Coefficients& medium = scene.objects[0].material.medium;
  medium = findMaterial(material, "").coefficients;
  medium.sigma_s /= 1 - g;
  medium.g = g;
  scene.lights.push_back(ParallelLight{.azimuth = 0, .elevation = 0, .irradiance = Rgb(1)});
  VolumeSolver solver;
  solver.update(scene, {.photons = 1 << 16});
  solver.refine();
  const Shares is = middleOf(solver, *scene.objects[0].mesh);

  const SlabResult truth = simulateSlab({.medium = medium, .thickness = thickness, .photons = 150'000});
  for (int c = 0; c < 3; ++c) {
    // Light that is mirrored by the bottom and leaves unscattered counts as reflected there, not here.
    const Rgb bounced = truth.unscattered_transmittance.value;
    const double R = truth.diffuse_reflectance.value[c],
                 T = truth.total_transmittance.value[c] - truth.unscattered_transmittance.value[c];
    const double noise =
        3 * (truth.diffuse_reflectance.standardError[c] + truth.total_transmittance.standardError[c]);
    EXPECT_NEAR(is.reflected[c], R, 0.03 * R + noise + 0.02 * bounced[c]) << material << " channel " << c;
    EXPECT_NEAR(is.transmitted[c], T, 0.03 * T + noise) << material << " channel " << c;
  }
}

TEST(SlabProperty, TheFirstPictureOfAThickSlabReflectsAsTransportSays) {
  for (const char* material : {"skin1", "fig6", "marble"}) {
    constexpr double kThickness = 60, kShape = 0.1;  // 6 cells
    Scene scene;
    scene.objects.push_back({.mesh = wideSlab(kShape), .size = kThickness / kShape});
    const Coefficients& medium = scene.objects[0].material.medium = findMaterial(material, "").coefficients;
    scene.lights.push_back(ParallelLight{.azimuth = 0, .elevation = 0, .irradiance = Rgb(1)});
    VolumeSolver solver;
    solver.update(scene, {});
    const Rgb is = middleOf(solver, *scene.objects[0].mesh).reflected;
    const SlabResult truth = simulateSlab({.medium = medium, .thickness = kThickness, .photons = 100'000});
    for (int c = 0; c < 3; ++c) {
      const double R = truth.diffuse_reflectance.value[c];
      EXPECT_NEAR(is[c], R, 0.015 * R + 3 * truth.diffuse_reflectance.standardError[c])
          << material << " " << c;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, SlabLadder,
                         testing::Combine(testing::Values("fig6", "skin1"), testing::Values(0.0, 0.8),
                                          testing::Values(0.1, 0.3, 1.0, 3.0, 10.0)));

}  // namespace
}  // namespace lychnite
