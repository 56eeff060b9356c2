#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lychnite/image/montage.h"

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <stb_truetype.h>

// Made by the build from DejaVuSans.ttf (embed_file.cmake).
extern const char lychniteFontBytes[];
extern const unsigned long lychniteFontSize;

namespace lychnite {
namespace {

const stbtt_fontinfo& font() {
  static const stbtt_fontinfo info = [] {
    stbtt_fontinfo made{};
    const auto* bytes = reinterpret_cast<const unsigned char*>(lychniteFontBytes);
    stbtt_InitFont(&made, bytes, stbtt_GetFontOffsetForIndex(bytes, 0));
    return made;
  }();
  return info;
}

/// Code points of UTF-8 text; a byte that belongs to none gives U+FFFD.
std::vector<int> codePoints(const std::string& text) {
  std::vector<int> points;
  for (size_t i = 0; i < text.size();) {
    const auto lead = uint8_t(text[i++]);
    const int following = lead < 0x80 ? 0 : lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : lead >= 0xc0 ? 1 : -1;
    int point = following <= 0 ? lead : lead & (0x3f >> following);
    int found = 0;
    while (found < following && i < text.size() && (uint8_t(text[i]) & 0xc0) == 0x80) {
      point = point << 6 | (uint8_t(text[i++]) & 0x3f);
      ++found;
    }
    points.push_back(found == following ? point : 0xfffd);
  }
  return points;
}

struct PlacedGlyph {
  int index;
  double x;  ///< of the origin, in pixels from the start of the line
};

struct Line {
  std::vector<PlacedGlyph> glyphs;
  double width = 0;
  float scale = 1;
};

Line layOut(const std::string& text, double pixelHeight) {
  Line line;
  line.scale = stbtt_ScaleForMappingEmToPixels(&font(), float(pixelHeight));
  int previous = -1;
  for (const int point : codePoints(text)) {
    const int glyph = stbtt_FindGlyphIndex(&font(), point);
    if (previous >= 0) line.width += double(line.scale) * stbtt_GetGlyphKernAdvance(&font(), previous, glyph);
    line.glyphs.push_back({glyph, line.width});
    int advance = 0, bearing = 0;
    stbtt_GetGlyphHMetrics(&font(), glyph, &advance, &bearing);
    line.width += double(line.scale) * advance;
    previous = glyph;
  }
  return line;
}

struct Bitmap {
  int left, top, width, height;
  std::vector<unsigned char> coverage;
};

Bitmap rasterize(int glyph, float scale, float shiftX, float shiftY) {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  stbtt_GetGlyphBitmapBoxSubpixel(&font(), glyph, scale, scale, shiftX, shiftY, &x0, &y0, &x1, &y1);
  Bitmap bitmap{x0, y0, x1 - x0, y1 - y0, {}};
  bitmap.coverage.resize(size_t(bitmap.width) * size_t(bitmap.height));
  if (!bitmap.coverage.empty())
    stbtt_MakeGlyphBitmapSubpixel(&font(), bitmap.coverage.data(), bitmap.width, bitmap.height, bitmap.width,
                                  scale, scale, shiftX, shiftY, glyph);
  return bitmap;
}

void blend(Image& image, const Bitmap& bitmap, int x, int y, const glm::vec3& colour) {
  for (int row = 0; row < bitmap.height; ++row)
    for (int column = 0; column < bitmap.width; ++column) {
      const int px = x + bitmap.left + column, py = y + bitmap.top + row;
      if (px < 0 || py < 0 || px >= image.width() || py >= image.height()) continue;
      const float part = float(bitmap.coverage[size_t(row) * size_t(bitmap.width) + size_t(column)]) / 255;
      const size_t pixel = size_t(py) * size_t(image.width()) + size_t(px);
      if (part > 0) image.setRgb(pixel, (1 - part) * image.rgb(pixel) + part * colour);
    }
}

}  // namespace

void drawText(Image& image, const std::string& text, double x, double y, double pixelHeight,
              const glm::vec3& linearColour) {
  for (const char* colour : {"R", "G", "B"}) image.addChannel(colour);
  const Line line = layOut(text, pixelHeight);
  for (const PlacedGlyph& glyph : line.glyphs) {
    const double left = x + glyph.x, wholeX = std::floor(left), wholeY = std::floor(y);
    const Bitmap bitmap = rasterize(glyph.index, line.scale, float(left - wholeX), float(y - wholeY));
    blend(image, bitmap, int(wholeX), int(wholeY), linearColour);
  }
}

double textWidth(const std::string& text, double pixelHeight) {
  return layOut(text, pixelHeight).width;
}

std::string_view labelFont() {
  return {lychniteFontBytes, lychniteFontSize};
}

}  // namespace lychnite
