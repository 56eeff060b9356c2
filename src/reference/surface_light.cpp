#include "reference/surface_light.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/surface.h"

namespace lychnite {

Rgb surfaceRadiance(const RayScene& rays, const Receiver& receiver, int light) {
  const Material& material = rays.scene().objects[size_t(receiver.hit.object)].material;
  const SurfaceCoat coat{.eta = material.medium.eta,
                         .roughness = material.roughness,
                         .base = material.opaque ? material.colour : Rgb(0)};
  Rgb sum(0);
  for (int l = 0; l < int(rays.lights().size()); ++l) {
    if (light >= 0 && l != light) continue;
    const RayLight::Seen seen = rays.lights()[size_t(l)].seenFrom(receiver.hit.position);
    const Rgb response = surfaceResponse(coat, receiver.normal, receiver.view, seen.direction);
    if (response == Rgb(0)) continue;
    const glm::vec3 towards(seen.direction);
    // Facets that face away while the interpolated normal does not are in their own shadow.
    if (glm::dot(towards, receiver.hit.normal) <= 0) continue;
    if (rays.occluded(offPoint(receiver.hit, towards), towards, float(seen.distance))) continue;
    sum += response * seen.irradiance;
  }
  return sum;
}

Rgb ambientRadiance(const RayScene& rays, const Receiver& receiver, const Rgb& reflectance) {
  const double eta = rays.scene().objects[size_t(receiver.hit.object)].material.medium.eta;
  const double cosO = std::clamp(double(glm::dot(receiver.normal, receiver.view)), 0.0, 1.0);
  const double entering = diffuseTransmittanceOutside(eta) * 3.14159265358979323846;
  return rays.scene().ambient *
         (fresnelReflectance(cosO, eta) + reflectance * (entering * exitLobe(cosO, eta)));
}

}  // namespace lychnite
