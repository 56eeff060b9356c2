// The size ladder: one object from 0.5 mm to 1 m, back-lit, in four materials, and the error of every method
// against its size.
#include <fmt/format.h>

#include "app/paper/chart.h"
#include "app/paper/methods.h"
#include "app/paper/parts.h"
#include "lychnite/base/units.h"
#include "lychnite/optics/materials.h"

namespace lychnite::paper {
namespace {

constexpr const char* kModel = "figurine";
constexpr const char* kMaterials[] = {"marble", "skin1", "wholemilk", "ketchup"};
constexpr ParallelLight kLight{.azimuth = 140, .elevation = 30};

/// mm.
std::vector<double> sizesOf(const Studio& studio) {
  if (studio.quick()) return {1, 10, 100};
  return {0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000};
}

Scene sceneOf(Studio& studio, const char* material, double size) {
  Scene scene;
  scene.objects = {studio.object(kModel)};
  scene.objects[0].material.medium = findMaterial(material, "paper").coefficients;
  scene.objects[0].size = size;
  scene.lights = {kLight};
  scene.camera = OrbitCamera{.factor = 0.8};
  return scene;
}

RenderSettings settingsOf(const Studio& studio, Method method) {
  RenderSettings settings;
  settings.width = studio.quick() ? 48 : 108;
  settings.height = studio.quick() ? 64 : 144;
  settings.method = method;
  settings.components.surface = false;
  if (studio.quick()) settings.passes = 1;
  if (method != Method::kWalk) return settings;
  settings.noise = studio.quick() ? 0.2 : 0.04;
  settings.timeLimit = studio.quick() ? 2 : 60;
  return settings;
}

/// One material: its strip, and its rows of the table.
class Rung {
 public:
  Rung(Studio& studio, const char* material, Table& table)
      : studio_(studio), material_(material), table_(table), methods_(comparedMethods()) {}

  void make() {
    for (const double size : sizesOf(studio_)) {
      const std::string at = fmt::format("{}-{:g}mm", material_, size);
      const Scene scene = sceneOf(studio_, material_, size);
      const Truth truth = truthOf(studio_, "walk-" + at, scene, settingsOf(studio_, Method::kWalk));
      std::vector<Image>& pictures = columns_.emplace_back();
      pictures.push_back(truth.mean);
      for (const MethodColumn& column : methods_) {
        pictures.push_back(
            studio_.picture(column.name + "-" + at, scene, settingsOf(studio_, column.method)));
        const Score score = scoreOf(pictures.back(), truth, exposureFor(truth.mean));
        std::vector<Cell> row{material_, size, column.label};
        for (Cell& cell : scoreCells(score)) row.push_back(std::move(cell));
        row.back() = truth.noise;
        table_.rows.push_back(std::move(row));
      }
    }
  }

  /// Rows: the walk and the methods; columns: their names, sizes; one exposure.
  Gallery gallery() const {
    const std::vector<double> sizes = sizesOf(studio_);
    ToneMapping tone;  // the mean of what would suit each size
    for (const std::vector<Image>& column : columns_)
      tone.exposure += exposureFor(column[0]) / double(columns_.size());
    Gallery gallery{.title = material_, .columns = int(sizes.size()) + 1, .cellWidth = 100};
    for (size_t m = 0; m <= methods_.size(); ++m) {
      if (m > 0 && !methods_[m - 1].inStrip) continue;
      const std::string method = m == 0 ? "walk" : methods_[m - 1].name;
      gallery.pictures.push_back({"", "", method, ""});
      for (size_t s = 0; s < sizes.size(); ++s) {
        const std::string file = fmt::format("{}-{}-{:g}mm", method, material_, sizes[s]);
        gallery.pictures.push_back(
            {studio_.show(file, columns_[s][m], tone), "", "", m == 0 ? formatLength(sizes[s]) : ""});
      }
    }
    gallery.caption = fmt::format("One exposure ({:+.2f} stops), each method as it is.", tone.exposure);
    return gallery;
  }

 private:
  Studio& studio_;
  const char* material_;
  Table& table_;
  std::vector<MethodColumn> methods_;
  std::vector<std::vector<Image>> columns_;  // by size, then the walk and the methods
};

/// The values of a column of the table for one material and method.
Series seriesOf(const Table& table, const char* material, const MethodColumn& method, size_t column) {
  Series series{.label = method.label, .style = method.style};
  for (const std::vector<Cell>& row : table.rows) {
    if (row[0].text != material || row[2].text != method.label) continue;
    series.x.push_back(row[1].number.value_or(0));
    series.y.push_back(100 * row[column].number.value_or(0));
  }
  return series;
}

Gallery charts(Studio& studio, const Table& table, size_t column, const char* name, const char* yLabel) {
  Gallery gallery{.columns = 2};
  for (const char* material : kMaterials) {
    Chart chart{.title = material, .xLabel = "size, mm", .yLabel = yLabel, .yFrom = 1, .yTo = 1000};
    for (const MethodColumn& method : comparedMethods())
      chart.series.push_back(seriesOf(table, material, method, column));
    const std::string file = fmt::format("{}-{}.svg", name, material);
    writeChart(chart, studio.file(file));
    gallery.pictures.push_back({file, "", "", ""});
  }
  return gallery;
}

}  // namespace

int ladderSteps(const Studio& studio) {
  return int(std::size(kMaterials) * sizesOf(studio).size() * (comparedMethods().size() + 2));
}

void makeLadder(Studio& studio, Report& report) {
  Table table{
      .name = "errors",
      .caption =
          "Light scattered inside (single and multiple, without the coat) against the walk's, R, G, B "
          "together, over the covered pixels; the walk's noise is taken out of the RMSE.",
      .columns = {{"material", "material"}, {"size, mm", "size_mm", 1}, {"method", "method"}}};
  for (Column& column : scoreColumns()) table.columns.push_back(column);
  table.columns.back() = {"walk's noise, %", "walk_noise", 1, 100};  // no times here
  for (const char* material : kMaterials) {
    Rung rung(studio, material, table);
    rung.make();
    report.blocks.push_back(rung.gallery());
  }
  Gallery asItIs = charts(studio, table, 3, "error", "relative RMSE, %");
  asItIs.caption = "Error against size, pictures as they are.";
  Gallery afterGain = charts(studio, table, 7, "error-after-gain", "relative RMSE after gain, %");
  afterGain.caption =
      "The same after one best factor per picture, which stands for a brightness set by hand.";
  report.blocks.push_back(asItIs);
  report.blocks.push_back(afterGain);
  report.blocks.push_back(table);
  report.differs =
      "Not in the paper, which varies the size of its objects but measures no error. What `hierarchical` "
      "has of error, which sums the dipole without a map, is the half-space that the dipole stands for "
      "(docs/accuracy.md).";
}

}  // namespace lychnite::paper
