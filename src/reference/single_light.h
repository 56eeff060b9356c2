#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "lychnite/base/progress.h"
#include "reference/camera_receivers.h"
#include "reference/transport.h"

namespace lychnite {

/// First-order scattering, integrated along the refracted eye ray (docs/physics.md, section 2), with [J01]'s
/// straight shadow ray: nearest exit of the ray towards the light, length corrected as if the surface there
/// were flat, and nothing between that exit and the light. Where [J01] eq. 6 leaves them out, the refracted
/// beam's width (cos_i/cos_t) and the radiance's fall on leaving (1/eta^2) are in, so that on a flat surface
/// the answer is exact and energy is kept. Light mirrored inside before or after the scattering is not in it.
class SingleLight {
 public:
  /// Both must outlive it.
  SingleLight(const RayScene& rays, const CameraReceivers& receivers);

  /// After the scene's media changed, but no index of refraction, shape or place.
  void updateMedia();

  /// One sample along every receiver's ray, added with the receivers' weights to `radiance` (one entry a
  /// pixel). The mean of many passes is the integral; passes 0, 1, 2... fill each ray evenly. `light` picks
  /// one, -1 takes all.
  void pass(uint64_t number, uint64_t seed, int light, std::vector<glm::vec3>& radiance) const;

  /// Mean of the first passes over all lights, one entry a pixel.
  std::vector<glm::vec3> mean(uint64_t passes, uint64_t seed, const Progress& progress) const;

  /// All lights by one sample a pixel, which neighbours of one surface share (Keller & Heidrich 2001,
  /// interleaved sampling), and two a receiver where a surface ends: as little noise as a dozen passes, but
  /// shadows inside are softened by some pixels. One entry a pixel.
  std::vector<glm::vec3> shared(const Progress& progress) const;

  size_t memoryBytes() const { return eyeRays_.capacity() * sizeof(EyeRay); }

 private:
  struct EyeRay {
    glm::vec3 from{0}, direction{0};  ///< refracted, just inside
    float length = 0;                 ///< to the object's far side; 0 where there is nothing to integrate
    float leaving = 0;                ///< Ft(cos_o) / eta^2
  };
  EyeRay eyeRay(const Receiver& receiver) const;
  glm::vec3 sample(const Receiver& receiver, const EyeRay& ray, float u, int light) const;
  glm::vec3 arriving(int object, const glm::vec3& point, const glm::vec3& outgoing,
                     const RayLight& light) const;

  const RayScene& rays_;
  const CameraReceivers& receivers_;
  std::vector<transport::Medium> media_;
  std::vector<EyeRay> eyeRays_;
};

}  // namespace lychnite
