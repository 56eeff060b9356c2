#pragma once

#include <glm/vec3.hpp>

namespace lychnite {

/// Henyey-Greenstein phase function, per steradian. `cosTheta` between the directions of travel before and
/// after.
double henyeyGreenstein(double cosTheta, double g);

/// Samples cosTheta of henyeyGreenstein from a uniform number u in [0, 1).
double sampleHenyeyGreenstein(double u, double g);

/// The direction at `cosTheta` from unit `d`, turned by azimuth `phi` (radians) about it.
glm::dvec3 deflect(const glm::dvec3& d, double cosTheta, double phi);

}  // namespace lychnite
