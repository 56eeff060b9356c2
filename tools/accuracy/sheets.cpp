#include "sheets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lychnite/image/io.h"
#include "lychnite/image/metrics.h"
#include "lychnite/image/montage.h"

namespace lychnite::accuracy {

namespace {

Image pictureOf(const Values& values, const Image& like) {
  Image image(like.width(), like.height());
  image.addChannel("A") = like.channel("A");
  for (size_t i = 0; i < values.size(); ++i) image.setRgb(i, values[i]);
  return image;
}

/// What brings the 98th percentile of the covered pixels' green to .8.
float exposureOf(const Image& picture) {
  std::vector<float> light;
  for (size_t i = 0; i < picture.pixelCount(); ++i)
    if (picture.channel("A")[i] == 1) light.push_back(picture.rgb(i).y);
  if (light.empty()) return 1;
  const size_t at = light.size() * 98 / 100;
  std::nth_element(light.begin(), light.begin() + ptrdiff_t(at), light.end());
  return 0.8f / std::max(light[at], 1e-9f);
}

/// The walk and the columns, then the columns' error maps.
std::vector<Image> picturesOf(const Workshop& workshop, const Cell& cell, const std::vector<Column>& columns,
                              int pixels, const Progress& progress) {
  const PictureTruth truth = workshop.references.picture(cell, pixels, progress);
  const Image& walk = truth.half[0];
  std::vector<Image> pictures{pictureOf(valuesOf(walk, "radiosity"), walk)};
  for (const Column& column : columns)
    pictures.push_back(pictureOf(workshop.models.inPicture(cell, column, pixels, progress), walk));
  const float exposure = exposureOf(pictures[0]);
  for (Image& picture : pictures)
    for (size_t i = 0; i < picture.pixelCount(); ++i) picture.setRgb(i, picture.rgb(i) * exposure);
  for (size_t i = 1; i <= columns.size(); ++i) pictures.push_back(errorMap(pictures[i], pictures[0]));
  return pictures;
}

}  // namespace

void writeSheet(const Workshop& workshop, const std::vector<Cell>& cells, std::vector<Column> columns,
                int pixels, const std::filesystem::path& path, const Progress& progress) {
  std::erase_if(columns, [](const Column& column) { return column.fromSecond; });
  std::vector<std::vector<Image>> rows;
  for (const Cell& cell : cells) rows.push_back(picturesOf(workshop, cell, columns, pixels, progress));
  const Image blank = pictureOf(Values(rows[0][0].pixelCount(), glm::vec3(0)), rows[0][0]);
  std::vector<Panel> panels;
  for (size_t r = 0; r < cells.size(); ++r) {
    panels.push_back({&rows[r][0], fmt::format("walk, {} mm", cells[r].size)});
    for (size_t c = 0; c < columns.size(); ++c) panels.push_back({&rows[r][c + 1], columns[c].name});
    panels.push_back({&blank, "error, 0 to 50 %"});
    for (size_t c = 0; c < columns.size(); ++c) panels.push_back({&rows[r][columns.size() + 1 + c], ""});
  }
  writePng(montage(panels, {}, int(columns.size() + 1)), path);
}

}  // namespace lychnite::accuracy
