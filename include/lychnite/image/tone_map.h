#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <string_view>

namespace lychnite {

struct ToneMapping {
  enum class Curve {
    kSrgb,    ///< clip at 1, then the sRGB transfer function
    kFilmic,  ///< Hable 2010's filmic curve (exposure bias 2, white at 11.2), then the sRGB transfer function
  };
  Curve curve = Curve::kSrgb;
  double exposure = 0;  ///< in stops: linear values are multiplied by 2^exposure first
};

/// "srgb", "filmic". Throws Error (Kind::kUsage).
ToneMapping::Curve parseToneCurve(std::string_view name, std::string_view where);
std::string toneCurveName(ToneMapping::Curve curve);

/// Linear scene value to a display value in [0, 1]; NaN gives 0.
glm::vec3 toneMap(const glm::vec3& linear, const ToneMapping& toneMapping);

/// The sRGB transfer function (IEC 61966-2-1) and its inverse, extended linearly below 0.
float srgbFromLinear(float linear);
float linearFromSrgb(float encoded);

}  // namespace lychnite
