#pragma once

#include "reference/camera_receivers.h"

namespace lychnite {

/// Light from one light (or all, -1) that a receiver's coat and, on opaque objects, its base send to the
/// camera, with traced shadows.
Rgb surfaceRadiance(const RayScene& rays, const Receiver& receiver, int light = -1);

/// What the uniform surrounding adds, unoccluded: its mirror image in the coat, and `reflectance` of what
/// entered (an opaque object's colour, the diffuse albedo of a translucent one).
Rgb ambientRadiance(const RayScene& rays, const Receiver& receiver, const Rgb& reflectance);

}  // namespace lychnite
