#pragma once

#include <glm/vec3.hpp>
#include <optional>

namespace lychnite {

/// Exact unpolarised dielectric Fresnel reflectance. `cosI` in [0, 1] on the side the light comes from, `eta`
/// = index of the far side over the near side. 1 for total internal reflection; 0 for eta = 1.
double fresnelReflectance(double cosI, double eta);

/// 1 - fresnelReflectance.
double fresnelTransmittance(double cosI, double eta);

/// Fdr, the mean internal diffuse reflectance: [J01] sect. 2.2's rational fit for 1 < eta <= 2 (Egan &
/// Hilgeman 1973, also for eta < 1), the exact value above, where the fit leaves it (and passes 1 at
/// eta 3.85), and exactly 0 at eta = 1, where the fit would leave 0.0016.
double diffuseFresnelReflectance(double eta);

/// 2 * integral over mu in [0,1] of Ft(eta, mu) mu: the diffuse transmittance from outside, C(eta) of S_w, in
/// Walsh's closed form (Walsh 1926).
double diffuseTransmittanceOutside(double eta);

/// First and second moments of the *internal* reflectance, C_i = integral over mu in [0,1] of R(1/eta, mu)
/// mu^i (d'Eon & Irving 2011 write 2 C1 and 3 C2 for these times 2 and 3).
double internalMoment(double eta, int i);

/// Angular shape of leaving light, S_w(cosO) = Ft(eta, cosO) / (pi C(eta)): its cosine-weighted integral over
/// the hemisphere is 1, so that leaving light integrates to the radiosity.
double exitLobe(double cosO, double eta);

/// Refracts the unit direction `d` (pointing along travel) at a surface of unit normal `n` (against d) with
/// relative index `eta` = far over near. Nothing on total internal reflection.
std::optional<glm::dvec3> refract(const glm::dvec3& d, const glm::dvec3& n, double eta);

}  // namespace lychnite
