#include "lychnite/image/tone_map.h"

#include <cmath>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

// Hable 2010, "Filmic Tonemapping Operators": shoulder and linear strength, linear angle, toe strength,
// numerator and denominator, linear white point, and the exposure bias of 2 he applies before the curve.
constexpr float kA = 0.15f, kB = 0.50f, kC = 0.10f, kD = 0.20f, kE = 0.02f, kF = 0.30f, kWhite = 11.2f;
constexpr float kExposureBias = 2;

float hable(float x) {
  return (x * (kA * x + kC * kB) + kD * kE) / (x * (kA * x + kB) + kD * kF) - kE / kF;
}

// Written so that NaN becomes 0, which std::clamp would let through.
float clampToUnit(float x) {
  return x > 0 ? (x < 1 ? x : 1) : 0;
}

float filmic(float x) {
  // Bounded before the curve: infinity / infinity would be NaN, and all above white is 1 anyway.
  const float bounded = x > 0 ? std::fmin(kExposureBias * x, kWhite) : 0;
  return hable(bounded) / hable(kWhite);
}

}  // namespace

ToneMapping::Curve parseToneCurve(std::string_view name, std::string_view where) {
  if (name == "srgb") return ToneMapping::Curve::kSrgb;
  if (name == "filmic") return ToneMapping::Curve::kFilmic;
  throw Error({.where = std::string(where),
               .expected = "a tone curve (srgb, filmic)",
               .found = "'" + std::string(name) + "'",
               .todo = ""},
              Error::Kind::kUsage);
}

std::string toneCurveName(ToneMapping::Curve curve) {
  return curve == ToneMapping::Curve::kFilmic ? "filmic" : "srgb";
}

glm::vec3 toneMap(const glm::vec3& linear, const ToneMapping& toneMapping) {
  const float gain = std::exp2(float(toneMapping.exposure));
  glm::vec3 display;
  for (int c = 0; c < 3; ++c) {
    const float exposed = gain * linear[c];
    const float curved = toneMapping.curve == ToneMapping::Curve::kFilmic ? filmic(exposed) : exposed;
    display[c] = srgbFromLinear(clampToUnit(curved));
  }
  return display;
}

// IEC 61966-2-1:1999, both directions.
float srgbFromLinear(float linear) {
  // 1.055 p - 0.055, in the order that gives exactly 1 at 1.
  return linear <= 0.0031308f ? 12.92f * linear : 1 + 1.055f * (std::pow(linear, 1 / 2.4f) - 1);
}

float linearFromSrgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

}  // namespace lychnite
