#pragma once

#include "lychnite/optics/profile.h"

namespace lychnite {

// What the spiral of the matched sampler takes from the profile (docs/physics.md, "The matched sampler").

/// Where the profile has passed on all but a thousandth part of its light, in the channel that reaches
/// farthest; in the profile's unit of length, as below.
double spiralReach(const Profile& profile);
/// Three times the mean core of the channels that scatter: the radius that half of the spiral's samples lie
/// within.
double spiralScale(const Profile& profile);

}  // namespace lychnite
