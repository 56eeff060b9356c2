#pragma once

#include "mesh/builtin/sdf.h"
#include "mesh/builtin/surface.h"

namespace lychnite::builtin {

/// Moves every vertex onto the zero level of the field.
void projectOnto(const Field& field, Surface& surface, int steps, double longest_step);

/// Makes triangles well shaped without changing their number: rounds of edge flips towards Delaunay, a move
/// along the surface towards the neighbours' mean (Botsch & Kobbelt 2004) and a step back onto the field's
/// zero level.
void relax(const Field& field, Surface& surface, int rounds, double longest_step);

/// The whole way from a field to a model of exactly `triangles` triangles.
struct ModelPlan {
  Bounds bounds;    ///< holds the surface with a cell to spare
  double cell = 0;  ///< of the grid the surface is first found on
  size_t triangles = 0;
  double evenness = 1e-3;  ///< see reduceTo
  int relax_rounds = 4;
};
Surface surfaceOf(const Field& field, const ModelPlan& plan);

}  // namespace lychnite::builtin
