#pragma once

#include "mesh/builtin/sdf.h"
#include "mesh/builtin/surface.h"

namespace lychnite::builtin {

/// The zero level of a field as a closed, consistently oriented manifold: marching cubes (Lorensen & Cline
/// 1987) with the polygons traced through the cell's faces rather than looked up, so that neighbours always
/// agree.
///
/// `bounds` must hold the whole surface with a cell to spare. The field's slope must be at most kMaxSlope:
/// blocks of cells that are farther from the surface than that allows are skipped after one look at their
/// centre.
inline constexpr double kMaxSlope = 1.25;
Surface contour(const Field& field, const Bounds& bounds, double cell);

}  // namespace lychnite::builtin
