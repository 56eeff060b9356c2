#include "app/paper/parts.h"

namespace lychnite::paper {

std::span<const Part> parts() {
  static constexpr Part kParts[] = {
      {"fig1", "Figure 1: one shape in two sizes", 1, 4, sizesSteps, makeSizes},
      {"fig3", "Figure 3: a map that is not fitted to its object", 1, 5, fittingSteps, makeFitting},
      {"fig4-5", "Figures 4 and 5: the sampling patterns over the map", 1, 2, patternSteps, makePatterns},
      {"fig6", "Figure 6: components of the light", 1, 4, componentsSteps, makeComponents},
      {"fig7", "Figure 7: the methods at three sizes", 1, 60, figure7Steps, makeFigure7},
      {"fig8", "Figure 8: the methods at three sizes, with another fixed pattern", 1, 70, figure8Steps,
       makeFigure8},
      {"table1", "Table 1: frames per second", 1, 10, speedSteps, makeSpeed},
      {"ladder", "From half a millimetre to a metre", 1, 100, ladderSteps, makeLadder},
      {"storage", "Storage: bytes of the map", 1, 1, storageSteps, makeStorage},
  };
  return kParts;
}

}  // namespace lychnite::paper
