#pragma once

#include <array>
#include <optional>

#include "lychnite/image/image.h"

namespace lychnite {

/// Errors of A against B over the pixels where B's alpha (1 where there is none) is above 0, alpha-weighted.
/// "Mean of B" is B's mean over those pixels (for "together": over the three channels as well; for a channel
/// in which B is black: that of all three).
struct Metrics {
  double relative_rmse = 0;  ///< RMSE / mean of B
  double bias = 0;           ///< (mean of A - mean of B) / mean of B
  double best_gain = 1;      ///< the one factor on A that minimises the RMSE, least squares (1 for a black A)
  double relative_rmse_after_gain = 0;  ///< relative RMSE of best_gain * A
  /// dB, of tone-mapped (sRGB, clipped) values over the whole picture; infinite when those are equal.
  double psnr = 0;
  double ssim =
      0;  ///< Wang et al. 2004, 11 x 11 Gaussian, of sRGB values ("together": of their Rec. 709 luma)
};

struct Comparison {
  Metrics together;                 ///< relative errors pool the three channels (one gain for all)
  std::array<Metrics, 3> channels;  ///< R, G, B
  double flip = 0;    ///< mean FLIP (Andersson et al. 2020), of sRGB values, at 67 pixels per degree
  size_t pixels = 0;  ///< pixels with B's alpha above 0
};

struct CompareOptions {
  double exposure = 0;  ///< stops, for the display-referred metrics (PSNR, SSIM, FLIP) only
  /// Take B's standard-error AOV ("stderr.R|G|B") out of the mean square error: an unbiased estimate of the
  /// error against what B would converge to. A relative_rmse below the noise is then reported as 0.
  bool useStandardError = false;
};

/// Compares the main pictures. Throws Error for different sizes, missing channels (or a missing "stderr"
/// layer when asked to use it), NaN or infinite pixels (naming the first), or a B that is black or nowhere
/// covered.
Comparison compare(const Image& a, const Image& b, const CompareOptions& options = {});

/// Display colour (sRGB, 0..1) of an error as a share of the largest shown: black-purple-red-orange-cream
/// with rising lightness. Twin: heat() of shaders/view/display.frag.
glm::vec3 errorColour(double share);

/// False-colour picture of |A - B| / mean of B per pixel (RGB average): errorColour() at 0 to `full` (1 = 100
/// %), dark grey where B's alpha is 0. The display values are put back to linear, so that writePng with the
/// plain sRGB curve shows them as they are. Throws Error as compare does.
Image errorMap(const Image& a, const Image& b, double full = 0.5);

/// Per-pixel FLIP in [0, 1] of the main pictures as the sRGB curve shows them. Throws Error as compare does.
std::vector<float> flipMap(const Image& a, const Image& b, double exposure = 0);

}  // namespace lychnite
