#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/phase.h"
#include "reference/ray_scene.h"
#include "reference/surface_samples.h"

namespace lychnite {

/// A walk without any art, to hold the others to: one channel, light thrown at a disc before the scene, every
/// flight traced, double precision, nothing but the rays shared. One closed translucent object in one
/// parallel light.
class PlainWalk {
 public:
  PlainWalk(const RayScene& rays, int channel, size_t patches, unsigned seed)
      : rays_(rays), sampler_(rays.mesh(0)), patches_(patches), random_(seed), light_(rays.lights()[0]) {
    const Coefficients medium = rays.medium(0);
    sigma_s_ = medium.sigma_s[channel];
    sigma_t_ = medium.sigma_t()[channel];
    g_ = medium.g;
    eta_ = medium.eta;
    power_ = light_.power[channel];
  }

  /// Radiosity of the patches by two halves of the photons.
  std::array<std::vector<double>, 2> radiosity(int photons) {
    std::array<std::vector<double>, 2> halves;
    const double each = power_ * std::numbers::pi * 2 / photons;  // a disc as large as the scene's sphere
    const double perArea = double(patches_) / sampler_.area();
    for (auto& half : halves) {
      half.assign(patches_, 0);
      for (int i = 0; i < photons / 2; ++i) fly(half, each * perArea);
    }
    return halves;
  }

 private:
  double uniform() { return std::uniform_real_distribution<double>()(random_); }

  void fly(std::vector<double>& exits, double weight) {
    const glm::dvec3 side = glm::normalize(glm::cross(light_.direction, glm::dvec3(0.3, 0.8, 0.5))),
                     up = glm::cross(light_.direction, side);
    const double r = std::sqrt(uniform()), phi = 2 * std::numbers::pi * uniform();
    glm::dvec3 at = 2.0 * light_.direction + r * (std::cos(phi) * side + std::sin(phi) * up);
    glm::dvec3 to = -light_.direction;
    bool inside = false, scattered = false;
    for (;;) {
      const RayHit hit = rays_.nearest(glm::vec3(at), glm::vec3(to));
      const double flight = inside ? -std::log1p(-uniform()) / sigma_t_ : 1e30;
      if (inside && hit && flight < double(hit.distance)) {
        if (uniform() * sigma_t_ > sigma_s_) return;
        at += flight * to;
        to = deflect(to, sampleHenyeyGreenstein(uniform(), g_), 2 * std::numbers::pi * uniform());
        scattered = true;
        continue;
      }
      if (!hit) return;
      // The boundary: mirrored or through.
      const glm::dvec3 out(hit.normal), n = inside ? -out : out;
      const double eta = inside ? 1 / eta_ : eta_;
      const double cosI = std::min(-glm::dot(to, n), 1.0);
      if (cosI <= 0) return;
      if (uniform() < fresnelReflectance(cosI, eta)) {
        to -= 2 * glm::dot(to, n) * n;
      } else {
        to = *refract(to, n, eta);
        if (inside && scattered) exits[sampler_.patchOf({hit.triangle, hit.u, hit.v}, patches_)] += weight;
        inside = !inside;
      }
      at = glm::dvec3(offPoint(hit, glm::vec3(to)));
    }
  }

  const RayScene& rays_;
  SurfaceSampler sampler_;
  size_t patches_;
  std::mt19937_64 random_;
  RayLight light_;
  double sigma_s_, sigma_t_, g_, eta_, power_;
};

}  // namespace lychnite
