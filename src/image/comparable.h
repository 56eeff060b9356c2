#pragma once

#include <vector>

#include "lychnite/image/image.h"

namespace lychnite {

/// Throws Error unless A and B have the same size and finite R, G, B everywhere.
void checkComparable(const Image& a, const Image& b);

/// Throws Error naming the first pixel that is not finite.
void checkFinite(const Image& image, const std::string& channel, const std::string& shownAs);

/// Alpha of every pixel, at least 0; 1 where there is no alpha. Throws Error when that is 0 everywhere.
std::vector<float> coverageOf(const Image& b);

/// Mean of the main picture's three channels, weighted. Throws Error when it is not above 0.
double meanColour(const Image& b, const std::vector<float>& weights);

}  // namespace lychnite
