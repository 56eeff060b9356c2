#pragma once

#include "mesh/builtin/surface.h"

namespace lychnite::builtin {

/// Collapses edges of a closed manifold, cheapest first, until exactly `triangles` are left (each collapse
/// removes two). Cost and place are the area-weighted quadric error (Garland & Heckbert 1997) with a share of
/// the edge's squared length, which keeps flat regions even; `evenness` is that share (0: shape only; 1e-3:
/// moderately even; 1: nearly equal edges). Collapses that would leave a non-manifold (the link condition,
/// Dey et al. 1999) or turn a triangle over are left out. Asserts that the number can be reached.
void reduceTo(Surface& surface, size_t triangles, double evenness);

}  // namespace lychnite::builtin
