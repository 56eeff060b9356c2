#pragma once

#include "reference/dipole.h"

namespace lychnite {

/// The sum over the surface by [J02]: evenly spread surface samples an eighth of the shortest mean free path
/// apart, lit by traced rays, put into an octree whose nodes stand for their samples where they are small as
/// seen from the receivers. Pixels that lie together share one traversal.
///
/// Bounded at any size: at least 64 Ki and at most 4 Mi samples of an object (about 300 MB while they are
/// made), and at most 2048 for each receiver where that is more than 128 Ki. Where these lie too far apart
/// for the profile's core, the kernel within twelve spacings of a receiver is integrated by probe rays with
/// the flat, evenly lit surface taken out exactly (NearField). Throws Interrupted.
DiffusionSum sumHierarchical(const RayScene& scene, const CameraReceivers& receivers,
                             const RenderSettings& settings, const DiffusionPart& part = {},
                             const Progress& progress = {});

}  // namespace lychnite
