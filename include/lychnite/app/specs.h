#pragma once

#include <string_view>

#include "lychnite/scene/scene.h"

namespace lychnite {

// The short texts in which front ends let people write a light, a camera, a colour. Each throws Error
// (Kind::kUsage) that begins with `where` and says what was expected.

/// "R,G,B" or one number for all three.
Rgb parseRgb(std::string_view text, std::string_view where);

/// "X,Y,Z", lengths with units, in mm.
glm::dvec3 parsePosition(std::string_view text, std::string_view where);

/// "parallel:AZ,EL[,E]" (degrees; irradiance one number or R,G,B, default pi) or "point:X,Y,Z[,I]" (lengths
/// with units; intensity in irradiance times mm^2, default what gives irradiance pi at the origin).
Light parseLight(std::string_view text, std::string_view where);

/// "orbit:AZ,EL[,FACTOR[,FOV]]" or "pinhole:PX,PY,PZ,TX,TY,TZ[,FOV]" (lengths with units, degrees).
Camera parseCamera(std::string_view text, std::string_view where);

struct Resolution {
  int width = 0, height = 0;
};
/// "WxH", both at least 1.
Resolution parseResolution(std::string_view text, std::string_view where);

}  // namespace lychnite
