#pragma once

#include <string>
#include <vector>

#include "lychnite/image/image.h"

namespace lychnite {

/// How far a picture may be from its golden, with the reason; in shares of the golden's pixel, or of its mean
/// over what is covered where the pixel is darker.
struct GoldenBounds {
  double inside = 0.01;  ///< any pixel that is fully covered, as are its neighbours
  double mean = 0.001;   ///< mean over all pixels
  std::string reason;
};

/// Compares the named layers ("" is the main picture) and the coverage with tests/golden/<name>.exr and fails
/// with result, reference and difference in the test output folder. With LYCHNITE_UPDATE_GOLDENS=1 it writes
/// the golden instead, with the eleven significant bits of a half float, and skips.
void expectGolden(const std::string& name, const Image& image, const std::vector<std::string>& layers,
                  const GoldenBounds& bounds);

}  // namespace lychnite
