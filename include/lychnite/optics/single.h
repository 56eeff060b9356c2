#pragma once

#include <glm/vec3.hpp>

namespace lychnite {

/// The geometry of single scattering in double precision; twins of shaders/lib/single.glsl. Lengths in any
/// one unit.

/// [J01] sect. 2.1: a straight distance `s` inside, under a surface that the light meets at cosI in (0, 1],
/// turned into the distance along the refracted ray: s cosI / cosT. `eta` = inside over outside, >= 1.
double refractedDistance(double s, double cosI, double eta);

/// The distance at which a share `u` in [0, 1] of an exponential of rate `sigma` >= 0, cut off at `end` > 0,
/// is passed.
double freePath(double u, double sigma, double end);

/// The density of freePath at `s` in [0, end] for uniform u.
double freePathDensity(double s, double sigma, double end);

/// How far the unit ray o + t d is inside the sphere: t where it leaves, 0 for a miss or a sphere behind.
double leaveSphere(const glm::dvec3& o, const glm::dvec3& d, const glm::dvec3& centre, double radius);

}  // namespace lychnite
