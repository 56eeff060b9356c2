#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lychnite/mesh/mesh.h"

namespace lychnite {

struct BuiltinModel {
  std::string name;
  std::string description;
  size_t triangles = 0, vertices = 0;
};

/// sphere, slab, disc, knot, stone, candle, figurine: made by our own code, deterministic, closed (the disc
/// excepted), y up, centred, longest side 1. Slab and disc face z; the figurine looks to -x and a little to
/// +z.
std::span<const BuiltinModel> builtinModels();

/// The named model (made on the first call, shared afterwards; thread-safe), or nothing for an unknown name.
std::shared_ptr<const Mesh> builtinMesh(std::string_view name);

}  // namespace lychnite
