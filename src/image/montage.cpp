#include "lychnite/image/montage.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

constexpr int kMargin = 16;
constexpr double kTextHeight = 20;
constexpr int kLabelHeight = 40;                          ///< of the strip that holds a label
constexpr int kBaseline = 27;                             ///< from the top of that strip
constexpr float kStripLevel = 0.09f, kTextLevel = 0.88f;  ///< display values

glm::vec3 grey(float display) {
  return glm::vec3(linearFromSrgb(display));
}

/// Where everything goes: columns as wide as their widest picture or label, rows as high as their highest
/// picture.
struct Layout {
  std::vector<int> columnX, columnWidth, rowY, rowHeight;
  int width = kMargin, height = kMargin;
};

Layout layOut(std::span<const Panel> panels, size_t columns) {
  Layout layout;
  layout.columnWidth.resize(columns);
  layout.rowHeight.resize((panels.size() + columns - 1) / columns);
  std::vector<int> labels(layout.rowHeight.size());
  for (size_t i = 0; i < panels.size(); ++i) {
    const Panel& panel = panels[i];
    assert(panel.image);
    int &width = layout.columnWidth[i % columns], &height = layout.rowHeight[i / columns];
    width = std::max({width, panel.image->width(), int(std::ceil(textWidth(panel.label, kTextHeight)))});
    height = std::max(height, panel.image->height());
    labels[i / columns] = std::max(labels[i / columns], panel.label.empty() ? kMargin : kLabelHeight);
  }
  for (const int width : layout.columnWidth) {
    layout.columnX.push_back(layout.width);
    layout.width += width + kMargin;
  }
  for (size_t row = 0; row < layout.rowHeight.size(); ++row) {
    layout.rowY.push_back(layout.height);
    layout.height += layout.rowHeight[row] + labels[row];
  }
  return layout;
}

void place(const Image& picture, const ToneMapping& toneMapping, int x, int y, Image& result) {
  const auto &r = picture.channel("R"), &g = picture.channel("G"), &b = picture.channel("B");
  std::vector<float>* out[] = {&result.addChannel("R"), &result.addChannel("G"), &result.addChannel("B")};
  for (int row = 0; row < picture.height(); ++row)
    for (int column = 0; column < picture.width(); ++column) {
      const size_t from = size_t(row) * size_t(picture.width()) + size_t(column);
      const size_t to = size_t(y + row) * size_t(result.width()) + size_t(x + column);
      const glm::vec3 shown = toneMap({r[from], g[from], b[from]}, toneMapping);
      for (int c = 0; c < 3; ++c) (*out[c])[to] = linearFromSrgb(shown[c]);
    }
}

}  // namespace

Image montage(std::span<const Panel> panels, const ToneMapping& toneMapping, int columns) {
  if (panels.empty())
    throw Error({.where = "montage", .expected = "at least one picture", .found = "none", .todo = ""});
  const size_t perRow = columns > 0 ? std::min(size_t(columns), panels.size()) : panels.size();
  const Layout layout = layOut(panels, perRow);
  Image result(layout.width, layout.height);
  for (const char* colour : {"R", "G", "B"})
    result.addChannel(colour).assign(result.pixelCount(), linearFromSrgb(kStripLevel));
  for (size_t i = 0; i < panels.size(); ++i) {
    const Panel& panel = panels[i];
    const size_t column = i % perRow, row = i / perRow;
    const int x = layout.columnX[column], y = layout.rowY[row], width = layout.columnWidth[column];
    place(*panel.image, toneMapping, x + (width - panel.image->width()) / 2, y, result);
    const double start = x + (width - textWidth(panel.label, kTextHeight)) / 2;
    drawText(result, panel.label, start, y + layout.rowHeight[row] + kBaseline, kTextHeight,
             grey(kTextLevel));
  }
  return result;
}

}  // namespace lychnite
