#pragma once

#include <string>
#include <string_view>

#include "lychnite/optics/coefficients.h"
#include "lychnite/scene/scene.h"

namespace lychnite {

/// The [object.material] table of a scene file.
std::string materialToToml(const Material& material);
/// The material that such a table (with or without its heading) describes. Throws Error with `where` and the
/// line.
Material materialFromToml(std::string_view text, std::string_view where);

/// The diffuse colour of a half-space of the medium: what coefficientsFromColour() would have been given, to
/// 1e-6. Channels that do not scatter are 0; albedos that no colour below 1 gives are 1.
Rgb colourOf(const Coefficients& medium);

}  // namespace lychnite
