#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lychnite/image/image.h"
#include "lychnite/image/tone_map.h"

namespace lychnite {

struct Panel {
  const Image* image = nullptr;
  std::string label;  ///< under the picture, one line of UTF-8; may be empty
};

/// Pictures side by side (wrapping after `columns`; 0 = one row), tone mapped, aligned at the top, each with
/// its label centred below on a plain dark strip. The result holds display-referred values already put back
/// to linear, so that writePng with the plain sRGB curve shows it as it is. Throws Error for no panel or one
/// without R, G, B.
Image montage(std::span<const Panel> panels, const ToneMapping& toneMapping, int columns = 0);

/// Draws one line of UTF-8 text (DejaVu Sans, built in) into the main picture, cut off at its edges; `x`,`y`
/// = left end of the baseline in pixels from the top left, `pixelHeight` = the font size (em) in pixels.
void drawText(Image& image, const std::string& text, double x, double y, double pixelHeight,
              const glm::vec3& linearColour);
/// The font of drawText, a TrueType file, for front ends that draw text themselves.
std::string_view labelFont();
/// How far drawText advances, in pixels.
double textWidth(const std::string& text, double pixelHeight);

}  // namespace lychnite
