#pragma once

#include <optional>
#include <vector>

#include "gpu/texture.h"
#include "lychnite/optics/profile.h"
#include "technique/frame.h"
#include "technique/key.h"

namespace lychnite {

/// The profile of every object's medium on the device: Rd per scene unit squared and P (rgb) over the
/// coordinate of shaders/lib/profile.glsl, and what the CPU needs beside it. Made anew when medium, size or
/// kind changes.
class ProfileCache {
 public:
  struct Entry {
    Key key;
    std::optional<gpu::Texture> table;  ///< rows from below: Rd, P
    double reach = 1;                   ///< beyond it the profile is dark, scene units
    double spiralScale = 1;             ///< of the matched sampler, scene units
    double coreLength = 1;              ///< mean over the channels, scene units; see Profile::coreLength
    float scale = 1;                    ///< of the table's coordinate, scene units
    Rgb total{0};                       ///< P(0), the diffuse reflectance of the half-space
    double piC = 1;                     ///< pi C(eta) of the exit lobe
  };
  /// Profiles are made by `maker` (makeProfile). Throws what it throws.
  void update(const Frame& frame, ProfileKind kind, const ProfileMaker& maker, const Progress& progress);
  const Entry& get(size_t object) const { return entries_[object]; }

 private:
  std::vector<Entry> entries_;
};

}  // namespace lychnite
