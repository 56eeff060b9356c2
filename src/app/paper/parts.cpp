#include "app/paper/parts.h"

namespace lychnite::paper {

std::span<const Part> parts() {
  static constexpr Part kParts[] = {
      {"fig1", "Figure 1: one shape in two sizes", 1, 4, sizesSteps, makeSizes},
      {"fig6", "Figure 6: components of the light", 1, 4, componentsSteps, makeComponents},
      {"storage", "Storage: bytes of the map", 1, 1, storageSteps, makeStorage},
  };
  return kParts;
}

}  // namespace lychnite::paper
