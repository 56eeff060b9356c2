#pragma once

#include <span>

#include "app/paper/studio.h"

namespace lychnite::paper {

/// One section of the page, made independently of the others.
struct Part {
  const char* name;
  const char* title;
  int revision;                        ///< raise it when the part comes out otherwise than before
  double cost;                         ///< about how long it takes, relative to the others
  int (*steps)(const Studio& studio);  ///< how many step()s `make` will take
  void (*make)(Studio& studio, Report& report);
};

/// In the order of the page.
std::span<const Part> parts();

// What makes each.
int sizesSteps(const Studio&);
void makeSizes(Studio&, Report&);  ///< Fig. 1
int fittingSteps(const Studio&);
void makeFitting(Studio&, Report&);  ///< Fig. 3
int patternSteps(const Studio&);
void makePatterns(Studio&, Report&);  ///< Fig. 4 and 5
int componentsSteps(const Studio&);
void makeComponents(Studio&, Report&);  ///< Fig. 6
int figure7Steps(const Studio&);
void makeFigure7(Studio&, Report&);
int figure8Steps(const Studio&);
void makeFigure8(Studio&, Report&);
int speedSteps(const Studio&);
void makeSpeed(Studio&, Report&);  ///< Table 1
int ladderSteps(const Studio&);
void makeLadder(Studio&, Report&);  ///< sizes in a strip, error against size
int storageSteps(const Studio&);
void makeStorage(Studio&, Report&);  ///< bytes of map per method

}  // namespace lychnite::paper
