#pragma once

#include <span>
#include <string>

#include "lychnite/image/image.h"
#include "lychnite/image/tone_map.h"

namespace lychnite {

struct Panel {
  const Image* image = nullptr;
  std::string label;  ///< under the picture, one line, UTF-8 Latin-1
};

/// Pictures side by side (wrapping after `columns`; 0 = one row), tone mapped, each with its label below on a plain
/// strip. The result holds display-referred values already put back to linear, so that writePng with the plain sRGB
/// curve shows it as it is.
Image montage(std::span<const Panel> panels, const ToneMapping& toneMapping, int columns = 0);

/// Draws one line of text (DejaVu Sans) into the main picture, `x`,`y` = left end of the baseline in pixels.
void drawText(Image& image, const std::string& text, double x, double y, double pixelHeight,
              const glm::vec3& linearColour);
/// Width in pixels that drawText would cover.
double textWidth(const std::string& text, double pixelHeight);

}  // namespace lychnite
