#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "lychnite/optics/profile.h"

namespace lychnite {

// The golden-angle spiral of the matched sampler in double precision (docs/physics.md, "The matched
// sampler").

/// Solves phi + e sin(phi) = m for m in [-pi, pi], e in [0, 1): azimuths whose density is (1 + e cos(phi)) /
/// 2 pi. To 1e-12.
double warpedAzimuth(double m, double e);

/// (cos, sin) of the warped azimuth for m from -pi to pi (kAzimuthColumns columns, both ends included) and
/// for eccentricities from 0 to kLargestEccentricity (kAzimuthRows rows): what the shader looks up instead of
/// solving for each sample of each pixel.
std::vector<glm::vec2> azimuthTable();

inline constexpr double kLargestEccentricity = 0.9;
inline constexpr int kAzimuthColumns = 257;
inline constexpr int kAzimuthRows = 64;

/// Where the profile has passed on all but a thousandth part of its light, in the channel that reaches
/// farthest; in the profile's unit of length, as below.
double spiralReach(const Profile& profile);
/// Three times the mean core of the channels that scatter: the radius that half of the spiral's samples lie
/// within.
double spiralScale(const Profile& profile);

}  // namespace lychnite
