#pragma once

#include <array>
#include <glm/vec4.hpp>

#include "lychnite/optics/coefficients.h"
#include "lychnite/scene/settings.h"

namespace lychnite {

/// L0 of eq. 4 in mm: the size at which log2 k is 0. The paper leaves it open; a fixed length would break the
/// invariance of light transport under scaling size and mean free path together, so it is 23 reduced mean
/// free paths (the mean of the channels'), 10 mm in the paper's own material.
double latticeReferenceSize(const Coefficients& medium);

/// The exponent's slope alpha K of eq. 4 for an object of `size` mm.
double latticeSlope(const LatticeConstants& constants, const Coefficients& medium, double size);

/// 7 x 7 cells: offset from the receiver's projection in texels (x, y), mip level, area in level-0 texels
/// (eq. 5 to 9). Levels are round(slope |x|), clamped to [0, maxLevel].
std::array<glm::vec4, 49> makeLattice(double slope, int maxLevel);

}  // namespace lychnite
