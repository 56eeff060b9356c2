#pragma once

#include <array>
#include <vector>

#include "image/filter.h"

namespace lychnite {

/// Per-pixel LDR-FLIP (Andersson et al. 2020) in [0, 1] of two pictures as linear R, G, B planes in [0, 1],
/// seen at 67.02 pixels per degree: a 0.7 m wide 3840-pixel display from 0.7 m.
std::vector<float> flipDifference(const std::array<Plane, 3>& test, const std::array<Plane, 3>& reference);

}  // namespace lychnite
