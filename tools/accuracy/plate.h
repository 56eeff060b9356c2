#pragma once

#include <memory>

#include "lychnite/mesh/mesh.h"

namespace lychnite::accuracy {

/// 0.12 x 1 x 0.7 with edges of radius 0.04.
std::shared_ptr<const Mesh> roundedPlate();

}  // namespace lychnite::accuracy
