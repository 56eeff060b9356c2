#pragma once

#include "lychnite/mesh/mesh.h"

namespace lychnite::builtin {

/// A fresh build of each built-in model; builtinMesh() is the cached way to them.
Mesh makeSphere();
Mesh makeSlab();
Mesh makeDisc();
Mesh makeKnot();
Mesh makeStone();
Mesh makeCandle();
Mesh makeFigurine();

}  // namespace lychnite::builtin
