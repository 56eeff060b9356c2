// Fig. 7 and 8: the methods side by side at three sizes, held against the walk.
#include <fmt/format.h>

#include <cmath>

#include "app/paper/methods.h"
#include "app/paper/parts.h"
#include "lychnite/base/units.h"
#include "lychnite/optics/materials.h"
#include "technique/multiple/lattice.h"

namespace lychnite::paper {
namespace {

constexpr double kSizes[] = {2.5, 10, 40};  // mm; the fixed pattern's own size is 10 in the paper's material

struct Figure {
  const char *model, *material;
  ParallelLight light;
  std::vector<MethodColumn> methods;
  std::string differs;
};

Scene sceneOf(Studio& studio, const Figure& figure, double size) {
  Scene scene;
  scene.objects = {studio.object(figure.model)};
  scene.objects[0].material.medium = findMaterial(figure.material, "paper").coefficients;
  scene.objects[0].size = size;
  scene.lights = {figure.light};
  scene.camera = OrbitCamera{.factor = 0.92};
  return scene;
}

RenderSettings settingsOf(const Studio& studio, const MethodColumn& column) {
  RenderSettings settings;
  settings.width = studio.quick() ? 90 : 300;
  settings.height = studio.quick() ? 120 : 400;
  settings.method = column.method;
  settings.lattice = column.lattice;
  if (studio.quick()) settings.passes = 1;
  return settings;
}

RenderSettings walkSettings(const Studio& studio) {
  RenderSettings settings = settingsOf(studio, {.method = Method::kWalk});
  settings.aovs = {"stderr"};
  settings.noise = studio.quick() ? 0.15 : 0.03;
  settings.timeLimit = studio.quick() ? 5 : 900;
  return settings;
}

/// What the figure shows of one method at one size.
struct Shown {
  std::string file, exr, label;
  Score score;
  Image picture, gained;
};

std::string percent(double share) {
  return share < 0.995 ? fmt::format("{:.1f} %", 100 * share) : fmt::format("{:.0f} %", 100 * share);
}

/// Four rows: pictures, their errors, pictures after one best gain, their errors; the walk in the last
/// column.
Gallery galleryOf(Studio& studio, const std::vector<Shown>& shown, const Image& walk,
                  const std::string& size) {
  const ToneMapping tone{.exposure = exposureFor(walk)};
  Gallery gallery{.columns = int(shown.size()) + 1};
  for (const Shown& s : shown)
    gallery.pictures.push_back(
        {studio.show(s.file, s.picture, tone), s.exr, s.label,
         fmt::format("RMSE {}, FLIP {:.3f}, {:.3g} s", percent(s.score.asItIs.relative_rmse), s.score.flip,
                     s.score.seconds)});
  const std::string name = "walk-" + size;
  gallery.pictures.push_back(
      {studio.show(name, walk, tone), name + ".exr", "walk",
       fmt::format("noise {}, {:.3g} s", percent(noiseOf(walk)), Studio::secondsOf(walk))});
  for (const Shown& s : shown)
    gallery.pictures.push_back(
        {studio.show(s.file + "-error", errorMap(s.picture, walk)), "", "", "its error"});
  gallery.pictures.push_back({"", "", "", "black to cream: error from 0 to 50 % of the walk's mean"});
  for (const Shown& s : shown)
    gallery.pictures.push_back(
        {studio.show(s.file + "-gain", s.gained, tone), "", "",
         fmt::format("times {:.2f}: RMSE {}, FLIP {:.3f}", s.score.asItIs.best_gain,
                     percent(s.score.asItIs.relative_rmse_after_gain), s.score.flipAfterGain)});
  gallery.pictures.push_back({"", "", "", "after the one factor that fits best"});
  for (const Shown& s : shown)
    gallery.pictures.push_back(
        {studio.show(s.file + "-gain-error", errorMap(s.gained, walk)), "", "", "its error"});
  gallery.pictures.push_back({"", "", "", ""});
  gallery.caption = fmt::format("{}, exposure {:+.2f} stops.", size, tone.exposure);
  return gallery;
}

void makeFigure(Studio& studio, Report& report, const Figure& figure) {
  Table table{
      .name = "errors",
      .caption =
          "Against the walk over the covered pixels, R, G, B together; the walk's noise is taken out of "
          "the RMSE (not out of FLIP). Time: real-time methods by the median of three frames in which "
          "all but the mesh changes, reading back included, on this device; the others on the CPU.",
      .columns = {{"size, mm", "size_mm", 1}, {"method", "method"}}};
  for (Column& column : scoreColumns()) table.columns.push_back(column);
  for (const double size : kSizes) {
    const std::string text = fmt::format("{:g}mm", size);
    const Scene scene = sceneOf(studio, figure, size);
    const Image walk = studio.picture("walk-" + text, scene, walkSettings(studio));
    const double exposure = exposureFor(walk);
    std::vector<Shown> shown;
    for (const MethodColumn& column : figure.methods) {
      Shown s{.file = column.name + "-" + text, .label = column.label};
      s.picture = studio.picture(s.file, scene, settingsOf(studio, column));
      s.exr = s.file + ".exr";
      s.score = scoreOf(s.picture, walk, exposure);
      s.gained = scaled(s.picture, s.score.asItIs.best_gain);
      std::vector<Cell> row{size, column.label};
      for (Cell& cell : scoreCells(s.score)) row.push_back(std::move(cell));
      table.rows.push_back(std::move(row));
      shown.push_back(std::move(s));
    }
    report.blocks.push_back(galleryOf(studio, shown, walk, text));
  }
  report.blocks.push_back(table);
  report.differs = figure.differs;
}

constexpr const char* kDiffers =
    "The paper shows its methods beside the hierarchical method and calls them similar; it gives no error "
    "and sets "
    "the brightness by hand, which one best factor stands for here. Walk and volume are not in it. Shape, "
    "sizes and "
    "light are ours: the paper does not state its own.";

Figure figure7() {
  return {.model = "figurine",
          .material = "fig6",
          .light = {.azimuth = 75, .elevation = 35},
          .methods = comparedMethods(),
          .differs = kDiffers};
}

Figure figure8() {
  Figure figure{.model = "candle",
                .material = "marble",
                .light = {.azimuth = 140, .elevation = 30},
                .methods = comparedMethods(),
                .differs = kDiffers};
  const double ownSize = latticeReferenceSize(findMaterial(figure.material, "paper").coefficients);
  MethodColumn other = figure.methods[0];
  other.name = "fixed-small";
  other.label = fmt::format("fixed, for {:g} mm", kSizes[0]);
  other.lattice.C1 -= other.lattice.C2 * std::log2(kSizes[0] / ownSize);
  figure.methods[0].label = fmt::format("fixed, for {:.1f} mm", ownSize);
  figure.methods.insert(figure.methods.begin() + 1, other);
  figure.differs +=
      " The second fixed pattern is the lattice frozen at the smallest size instead of its own.";
  return figure;
}

}  // namespace

int figure7Steps(const Studio&) {
  return int(std::size(kSizes) * (comparedMethods().size() + 1));
}

int figure8Steps(const Studio&) {
  return int(std::size(kSizes) * (comparedMethods().size() + 2));
}

void makeFigure7(Studio& studio, Report& report) {
  makeFigure(studio, report, figure7());
}

void makeFigure8(Studio& studio, Report& report) {
  makeFigure(studio, report, figure8());
}

}  // namespace lychnite::paper
