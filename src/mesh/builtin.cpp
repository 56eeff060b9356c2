#include "lychnite/mesh/builtin.h"

#include <array>
#include <cassert>
#include <mutex>

#include "mesh/builtin/models.h"

namespace lychnite {
namespace {

struct Recipe {
  BuiltinModel model;
  Mesh (*make)();
};

const auto& recipes() {
  static const std::array all = std::to_array<Recipe>({
      {{"sphere", "a finely subdivided ball", 20480, 10242}, builtin::makeSphere},
      {{"slab", "a plate of 1 x 1 x 0.1 with sharp edges, thin along z", 7680, 4182}, builtin::makeSlab},
      {{"disc", "a flat round disc facing +z; the one open mesh", 32768, 16641}, builtin::makeDisc},
      {{"knot", "a trefoil tied of a round tube", 30720, 15360}, builtin::makeKnot},
      {{"stone", "a rounded faceted stone", 1114, 559}, builtin::makeStone},
      {{"candle", "a half-melted candle with a wick and runs of wax", 12136, 6070}, builtin::makeCandle},
      {{"figurine", "a carved chess knight: a thick neck, thin ears and mane", 31398, 15701},
       builtin::makeFigurine},
  });
  return all;
}

}  // namespace

std::span<const BuiltinModel> builtinModels() {
  static const std::vector<BuiltinModel> models = [] {
    std::vector<BuiltinModel> list;
    for (const Recipe& recipe : recipes()) list.push_back(recipe.model);
    return list;
  }();
  return models;
}

std::shared_ptr<const Mesh> builtinMesh(std::string_view name) {
  struct Slot {
    std::once_flag once;
    std::shared_ptr<const Mesh> mesh;
  };
  static std::array<Slot, std::tuple_size_v<std::remove_cvref_t<decltype(recipes())>>> slots;
  for (size_t i = 0; i < slots.size(); ++i) {
    const Recipe& recipe = recipes()[i];
    if (recipe.model.name != name) continue;
    std::call_once(slots[i].once, [&] {
      Mesh mesh = recipe.make();
      mesh.extent = extentOf(mesh);
      slots[i].mesh = std::make_shared<const Mesh>(std::move(mesh));
      assert(slots[i].mesh->triangles.size() == recipe.model.triangles);
      assert(slots[i].mesh->positions.size() == recipe.model.vertices);
    });
    return slots[i].mesh;
  }
  return nullptr;
}

}  // namespace lychnite
