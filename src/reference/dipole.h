#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "lychnite/base/progress.h"
#include "lychnite/optics/profile.h"
#include "lychnite/scene/settings.h"
#include "reference/camera_receivers.h"
#include "reference/ray_scene.h"

namespace lychnite {

/// B(x_o) = sum over surface samples of Rd(|x_s - x_o|) Phi_s at every receiver, and how it was reached.
struct DiffusionSum {
  std::vector<glm::vec3> radiosity;  ///< one for each receiver; 0 on opaque objects
  double error = 0;                  ///< estimated relative RMSE of the sum, 0 where none is estimated
  size_t samples = 0;                ///< surface samples, of all objects
};

/// What is summed: whose light and which profile.
struct DiffusionPart {
  int light = -1;         ///< one of the scene's lights, -1 for all
  ProfileMaker profiles;  ///< empty: formulas only
  ProfileOrders orders = ProfileOrders::kAll;
};

/// The receivers that lie on one object.
struct ObjectReceivers {
  std::vector<uint32_t> index;  ///< into CameraReceivers::receivers
  std::vector<RayHit> hits;
};
ObjectReceivers receiversOf(const CameraReceivers& receivers, int object);

/// The dipole integral (of any profile) for the judge's use: unbiased, and refined until the estimated
/// relative RMSE over the receivers is below settings.tolerance.
///
/// The kernel is cut by smooth windows into shells. The outermost is summed over all of a first set of
/// surface samples; each next one, half as wide, over samples twice as dense, until they resolve the
/// profile's core; what then is left about the receiver is integrated by probe rays (NearField). Every part
/// is a stratified Monte Carlo estimate of its share of the integral, so two independent sums differ by their
/// noise alone, and half their difference is the error of their mean. The samples of all shells and the
/// probes double until that is small enough or the bounds (8 Mi samples of an object, 16 times the probes)
/// are met. Throws Interrupted.
DiffusionSum sumDipole(const RayScene& scene, const CameraReceivers& receivers,
                       const RenderSettings& settings, const DiffusionPart& part = {},
                       const Progress& progress = {});

}  // namespace lychnite
