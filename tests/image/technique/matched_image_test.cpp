// Laws of the matched sampler: the half-space, the sum over a closed object, steadiness.
#include <glm/geometric.hpp>
#include <numbers>

#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/materials.h"
#include "lychnite/optics/profile.h"
#include "render_test.h"

namespace lychnite {
namespace {

using MatchedImage = RenderTest;

RenderSettings matched(int samples, int size = 32) {
  RenderSettings settings = smallPicture(Method::kMatched, size);
  settings.components = only("multiple");
  settings.multipleSamples = samples;
  return settings;
}

TEST_F(MatchedImage, TheMiddleOfADiscIsTheProfilesShareWithinIt) {
  // White enough that the profile reaches far, one reduced mean free path 1 mm.
  const Coefficients medium{.sigma_s = Rgb(0.99, 0.95, 0.6), .sigma_a = Rgb(0.01, 0.05, 0.4), .eta = 1.3};
  const auto profile = makeProfile(ProfileKind::kDipole, medium);
  for (const double size : {0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0})
    for (const int samples : {16, 31, 128}) {
      Scene scene = oneObject("disc", size);
      scene.objects[0].material.medium = medium;
      scene.lights = {ParallelLight{.azimuth = 0, .elevation = 0}};
      scene.camera = distantCamera({0, 0, 1}, 0.02 * size);
      const Rgb share = profile->P(0) - profile->P(size / 2);
      const Rgb expected =
          std::numbers::pi * fresnelTransmittance(1, medium.eta) * exitLobe(1, medium.eta) * share;
      // A half-space to the profile, or smaller than it: else the disc's edge runs through the outer cells.
      const bool edge = size == 1 || size == 10;
      const double tolerance = !edge ? 0.005 : samples > 100 ? 0.006 : 0.015;
      const glm::dvec3 found = centreOf(render(scene, matched(samples)));
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c] / expected[c], 1, tolerance)
            << size << " mm, " << samples << " samples, channel " << c;
    }
}

/// Radiance of the multiple scattering of a sphere of diameter `size` in parallel light from +z, by summing
/// the profile over its lit half.
class LitSphere {
 public:
  /// Irradiance pi, the light's default.
  LitSphere(double size, const Coefficients& medium)
      : radius_(size / 2), eta_(medium.eta), table_(*makeProfile(ProfileKind::kDipole, medium), 1) {
    constexpr int kRings = 120;
    for (int i = 0; i < kRings; ++i) {
      // Equal steps of the squared distance from the axis: equal areas across the light.
      const double rho = radius_ * std::sqrt((i + 0.5) / kRings),
                   z = std::sqrt(radius_ * radius_ - rho * rho);
      const int turns = 12 + i;
      for (int k = 0; k < turns; ++k) {
        const double angle = 2 * std::numbers::pi * (k + 0.5 * (i % 2)) / turns;
        sources_.push_back({{rho * std::cos(angle), rho * std::sin(angle), z},
                            std::numbers::pi * std::numbers::pi * radius_ * radius_ / kRings / turns *
                                fresnelTransmittance(z / radius_, eta_)});
      }
    }
  }
  Rgb radiance(const glm::dvec3& normal, double cosO) const {
    Rgb sum(0);
    for (const Source& source : sources_)
      sum += source.flux * Rgb(table_.Rd(glm::distance(radius_ * normal, source.position)));
    return sum * exitLobe(cosO, eta_);
  }

 private:
  struct Source {
    glm::dvec3 position;
    double flux;
  };
  double radius_, eta_;
  ProfileTable table_;
  std::vector<Source> sources_;
};

TEST_F(MatchedImage, TheSumOverASphereIsConserved) {
  constexpr int kSize = 48;
  const Coefficients medium = findMaterial("fig6", "").coefficients;
  for (const double size : {1.0, 5.0, 20.0}) {
    const LitSphere truth(size, medium);
    Scene scene = oneObject("sphere", size, "fig6");
    scene.lights = {ParallelLight{.azimuth = 0, .elevation = 0}};
    Rgb found(0), expected(0);
    for (const glm::dvec3& towards : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1)}) {
      scene.camera = distantCamera(towards, 1.1 * size);
      const Image image = render(scene, matched(32, kSize));
      const glm::dvec3 right = glm::cross(glm::dvec3(0, 1, 0), towards);
      for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
          const glm::dvec2 p = (glm::dvec2(x + 0.5, kSize - y - 0.5) / double(kSize) * 2.0 - 1.0) * 1.1;
          const double cos2 = 1 - glm::dot(p, p);
          // Away from the rim, where a pixel's middle does not stand for the pixel.
          if (cos2 < 0.2) continue;
          const double cosO = std::sqrt(cos2);
          found += Rgb(image.rgb(pixelAt(image, x, y)));
          expected += truth.radiance(p.x * right + p.y * glm::dvec3(0, 1, 0) + cosO * towards, cosO);
        }
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1, 0.01) << size << " mm, channel " << c;
  }
}

/// Root mean square over pixels and frames of what is left of each pixel's course after its straight line,
/// over the picture's mean.
double fluctuation(const std::vector<Image>& frames) {
  const size_t n = frames.size();
  const Image& first = frames.front();
  double error = 0, mean = 0;
  size_t count = 0;
  for (size_t i = 0; i < first.pixelCount(); ++i) {
    if (first.channel("A")[i] < 1) continue;
    double s = 0, st = 0, tt = 0, ss = 0;
    for (size_t k = 0; k < n; ++k) {
      const double t = double(k) - 0.5 * double(n - 1), v = double(frames[k].rgb(i).y);
      s += v, st += v * t, tt += t * t, ss += v * v;
    }
    error += (ss - s * s / double(n) - st * st / tt) / double(n);
    mean += s / double(n);
    ++count;
  }
  return std::sqrt(std::max(0.0, error) / double(count)) / (mean / double(count));
}

TEST_F(MatchedImage, SteadyUnderSlowLightAndSize) {
  const struct {
    double size, bound;
  } kBounds[] = {{1, 0.005}, {10, 0.005}, {30, 0.005}, {100, 0.01}, {300, 0.03}};
  for (const char* model : {"sphere", "figurine"})
    for (const auto& [size, bound] : kBounds) {
      std::vector<Image> turning, growing;
      for (int k = 0; k < 8; ++k) {
        Scene scene = oneObject(model, size, "fig6");
        scene.lights = {ParallelLight{.azimuth = 20 + 0.1 * k, .elevation = 35}};
        turning.push_back(render(scene, matched(32, 64)));
        scene.lights = {ParallelLight{.azimuth = 20, .elevation = 35}};
        scene.objects[0].size = size * std::pow(1.001, k);
        growing.push_back(render(scene, matched(32, 64)));
      }
      EXPECT_LT(fluctuation(turning), bound) << model << ", " << size << " mm, light";
      EXPECT_LT(fluctuation(growing), bound) << model << ", " << size << " mm, size";
    }
}

TEST_F(MatchedImage, ALargePictureIsTheSmallOneWithMoreDetail) {
  // More pixels than are shaded at once (2^19), so that the larger picture is made in bands; one more row and
  // column than whole blocks of pixels.
  Scene scene = oneObject("figurine", 20, "fig6");
  scene.lights = {ParallelLight{.azimuth = -40, .elevation = 35}};
  const Image large = render(scene, matched(16, 801)), small = render(scene, matched(16, 89));
  double error = 0, mean = 0;
  for (int y = 0; y < 89; ++y)
    for (int x = 0; x < 89; ++x) {
      double sum = 0;
      for (int i = 0; i < 81; ++i)
        sum += double(large.rgb(size_t(9 * y + i / 9) * 801 + size_t(9 * x + i % 9)).y) / 81;
      const double one = double(small.rgb(size_t(y) * 89 + size_t(x)).y);
      error += (sum - one) * (sum - one);
      mean += one;
    }
  EXPECT_LT(std::sqrt(error / (89.0 * 89)) / (mean / (89.0 * 89)), 0.05);
}

}  // namespace
}  // namespace lychnite
