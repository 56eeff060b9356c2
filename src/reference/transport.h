#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lychnite/optics/coefficients.h"

/// The transport of light in a homogeneous medium behind a smooth dielectric boundary, in single precision:
/// what a photon of the walk and of the slab is made of. Each function has a twin in double precision in
/// optics/, and the unit tests hold the two together.
namespace lychnite::transport {

constexpr float kPi = 3.14159265358979f;

/// xoshiro128++ (Blackman & Vigna 2019), seeded by splitmix64 of (seed, stream): streams are independent, so
/// a block of photons gives the same paths whatever thread runs it.
class Rng {
 public:
  Rng(uint64_t seed, uint64_t stream) {
    uint64_t x = seed * 0x9E3779B97F4A7C15ull + (stream + 1) * 0xD1342543DE82EF95ull;
    for (int i = 0; i < 4; i += 2) {
      const uint64_t z = splitmix(x);
      state_[i] = uint32_t(z);
      state_[i + 1] = uint32_t(z >> 32);
    }
  }

  uint32_t bits() {
    const uint32_t result = rotl(state_[0] + state_[3], 7) + state_[0];
    const uint32_t t = state_[1] << 9;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = rotl(state_[3], 11);
    return result;
  }
  /// In [0, 1).
  float uniform() { return float(bits() >> 8) * 0x1p-24f; }
  /// Exponentially distributed with mean 1; up to 22.
  float exponential() { return -std::log((float(bits()) + 1.0f) * 0x1p-32f); }
  /// In 0..n-1, for small n.
  uint32_t below(uint32_t n) { return uint32_t((uint64_t(bits()) * n) >> 32); }

 private:
  static uint32_t rotl(uint32_t x, int k) { return (x << k) | (x >> (32 - k)); }
  static uint64_t splitmix(uint64_t& x) {
    uint64_t z = (x += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  uint32_t state_[4];
};

/// Coefficients in any one unit of length.
struct Medium {
  glm::vec3 sigma_s{0}, sigma_a{0}, sigma_t{0};
  float g = 0, eta = 1;

  Medium() = default;
  explicit Medium(const Coefficients& c)
      : sigma_s(c.sigma_s), sigma_a(c.sigma_a), sigma_t(c.sigma_t()), g(float(c.g)), eta(float(c.eta)) {}
};

/// Reflectance of a boundary and the cosine on its far side.
struct Boundary {
  float reflectance = 1;
  float cosT = 0;
};
/// Exact unpolarised dielectric Fresnel. `eta` = index of the far side over the near side.
inline Boundary fresnel(float cosI, float eta) {
  if (eta == 1.0f) return {0.0f, cosI};
  const float sin2T = (1.0f - cosI * cosI) / (eta * eta);
  if (sin2T >= 1.0f) return {};
  const float cosT = std::sqrt(1.0f - sin2T);
  const float s = (cosI - eta * cosT) / (cosI + eta * cosT);
  const float p = (eta * cosI - cosT) / (eta * cosI + cosT);
  return {0.5f * (s * s + p * p), cosT};
}

/// Direction of travel `d` mirrored at a surface of unit normal `n` (either side).
inline glm::vec3 mirrored(const glm::vec3& d, const glm::vec3& n) {
  return d - 2.0f * glm::dot(d, n) * n;
}

/// Direction of travel `d` refracted at a surface whose unit normal `n` is against it, with the cosines of
/// fresnel().
inline glm::vec3 refracted(const glm::vec3& d, const glm::vec3& n, float eta, float cosI, float cosT) {
  return glm::normalize(d / eta + (cosI / eta - cosT) * n);
}

/// Cosine of the deflection by Henyey-Greenstein from u in [0, 1).
inline float henyeyGreensteinCosine(float u, float g) {
  if (std::abs(g) < 1e-3f) return 1.0f - 2.0f * u + 1.5f * g * (1.0f - (1.0f - 2.0f * u) * (1.0f - 2.0f * u));
  const float q = (1.0f - g * g) / (1.0f + g - 2.0f * g * u);
  return std::fmin(1.0f, std::fmax(-1.0f, (1.0f + g * g - q * q) / (2.0f * g)));
}

/// Henyey-Greenstein phase function, 1/sr.
inline float henyeyGreenstein(float cosine, float g) {
  const float d = 1.0f + g * g - 2.0f * g * cosine;
  return (1.0f - g * g) / (4.0f * kPi * d * std::sqrt(d));
}

/// The unit direction at `cosine` from unit `d`, turned by `phi` about it (frame of Duff et al. 2017).
inline glm::vec3 deflected(const glm::vec3& d, float cosine, float phi) {
  const float sign = std::copysign(1.0f, d.z);
  const float a = -1.0f / (sign + d.z), b = d.x * d.y * a;
  const glm::vec3 t(1.0f + sign * d.x * d.x * a, sign * b, -sign * d.x);
  const glm::vec3 s(b, sign + d.y * d.y * a, -d.y);
  const float sine = std::sqrt(std::fmax(0.0f, 1.0f - cosine * cosine));
  return glm::normalize(t * (sine * std::cos(phi)) + s * (sine * std::sin(phi)) + d * cosine);
}

/// Direction after one scattering.
inline glm::vec3 scattered(const glm::vec3& d, float g, Rng& rng) {
  const float u = rng.uniform(), phi = 2.0f * kPi * rng.uniform();
  if (g == 0.0f) {
    const float z = 1.0f - 2.0f * u, r = std::sqrt(std::fmax(0.0f, 1.0f - z * z));
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  return deflected(d, henyeyGreensteinCosine(u, g), phi);
}

/// What a photon carries in the three channels. The path is drawn with the extinction of one channel, taken
/// evenly from the three; the weights are f_c / mean of the three channels' densities of the path (one-sample
/// balance heuristic, Veach & Guibas 1995 eq. 15), so that one path serves all channels, without bias, and no
/// weight exceeds three times that of a path drawn for the channel alone.
class PathWeight {
 public:
  PathWeight() = default;
  PathWeight(const glm::vec3& flux, int channel) : flux_(flux), channel_(channel) {}

  const glm::vec3& flux() const { return flux_; }
  float largest() const { return std::fmax(flux_.x, std::fmax(flux_.y, flux_.z)); }
  /// The channel whose extinction draws this path's flights.
  int channel() const { return channel_; }

  /// Free flight drawn for this path; infinite where the channel's medium is empty.
  float drawFlight(const Medium& medium, Rng& rng) const {
    return rng.exponential() / medium.sigma_t[channel_];
  }
  /// The path went `distance` without a collision.
  void pass(const Medium& medium, float distance) {
    const glm::vec3 t = relativeTransmittance(medium, distance);
    update(flux_ * t, density_ * t);
  }
  /// The path went `distance` and was scattered there. Returns the flux that the collision absorbed.
  glm::vec3 scatter(const Medium& medium, float distance) {
    const glm::vec3 t = relativeTransmittance(medium, distance);
    const glm::vec3 colliding = flux_ * t;
    const float scale = update(colliding * medium.sigma_s, density_ * t * medium.sigma_t);
    return colliding * medium.sigma_a * scale;
  }
  /// Expected flux, in all channels, of going `distance` from here without a collision.
  glm::vec3 passing(const Medium& medium, float distance) const {
    return {flux_.x * std::exp(-medium.sigma_t.x * distance),
            flux_.y * std::exp(-medium.sigma_t.y * distance),
            flux_.z * std::exp(-medium.sigma_t.z * distance)};
  }
  void scale(float factor) { flux_ *= factor; }
  /// Russian roulette of a path that carries less than `threshold`; false ends it.
  bool survives(float threshold, Rng& rng) {
    if (largest() >= threshold) return true;
    if (largest() <= 0 || rng.uniform() >= kSurvival) return false;
    scale(1 / kSurvival);
    return true;
  }

 private:
  static constexpr float kSurvival = 0.2f;

  /// exp(-sigma_t distance) over the drawing channel's: only ratios count, and this one cannot underflow for
  /// all.
  glm::vec3 relativeTransmittance(const Medium& medium, float distance) const {
    glm::vec3 t(1.0f);
    const float drawn = medium.sigma_t[channel_];
    for (int c = 0; c < 3; ++c)
      if (medium.sigma_t[c] != drawn) t[c] = std::exp((drawn - medium.sigma_t[c]) * distance);
    return t;
  }
  float update(const glm::vec3& flux, const glm::vec3& density) {
    const float scale = 3.0f / (density.x + density.y + density.z);
    flux_ = flux * scale;
    density_ = density * scale;
    return scale;
  }

  glm::vec3 flux_{0};
  glm::vec3 density_{1};  ///< of the path so far if drawn for each channel; mean 1
  int channel_ = 0;
};

}  // namespace lychnite::transport
