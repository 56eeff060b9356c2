// Fig. 7 and 8: the methods side by side at three sizes, held against the walk.
#include <fmt/format.h>

#include <cmath>

#include "app/paper/methods.h"
#include "app/paper/parts.h"
#include "lychnite/base/units.h"
#include "lychnite/image/metrics.h"
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
  scene.camera = OrbitCamera{.factor = 0.8};
  return scene;
}

RenderSettings settingsOf(const Studio& studio, const MethodColumn& column) {
  RenderSettings settings;
  settings.width = studio.quick() ? 90 : 300;
  settings.height = studio.quick() ? 120 : 400;
  settings.method = column.method;
  settings.mostMapSize = settings.mapSize;  // the paper's
  settings.lattice = column.lattice;
  if (studio.quick()) settings.passes = 1;
  return settings;
}

RenderSettings walkSettings(const Studio& studio) {
  RenderSettings settings = settingsOf(studio, {.method = Method::kWalk});
  settings.noise = studio.quick() ? 0.1 : 0.03;
  settings.timeLimit = studio.quick() ? 6 : 600;
  return settings;
}

/// What the figure shows of one method at one size.
struct Shown {
  std::string file, label;
  Score score;
  Image picture, gained;
};

void addRow(Studio& studio, Gallery& gallery, const std::vector<Shown>& shown, const Truth& truth,
            bool afterGain, const ToneMapping& tone) {
  for (const Shown& s : shown) {
    Picture& picture = gallery.pictures.emplace_back();
    if (afterGain) {
      picture.file = studio.show(s.file + "-gain", s.gained, tone);
      picture.detail = fmt::format("times {:.2f}: RMSE {}, FLIP {:.3f}", s.score.gain,
                                   percent(s.score.rmseAfterGain), s.score.flipAfterGain);
    } else {
      picture = {studio.show(s.file, s.picture, tone), s.file + ".exr", s.label,
                 fmt::format("RMSE {}, FLIP {:.3f}, {:.2g} s", percent(s.score.rmse), s.score.flip,
                             s.score.seconds)};
    }
  }
  gallery.pictures.push_back({"", "", "", afterGain ? "after the one factor that fits best" : ""});
  for (const Shown& s : shown)
    gallery.pictures.push_back({studio.show(s.file + (afterGain ? "-gain-error" : "-error"),
                                            errorMap(afterGain ? s.gained : s.picture, truth.mean)),
                                "", "", "error"});
  gallery.pictures.push_back({"", "", "", "black to cream: error from 0 to 50 % of the walk's mean"});
}

/// Four rows: pictures, their errors, pictures after one best gain, their errors; the walk ends the first.
Gallery galleryOf(Studio& studio, const std::vector<Shown>& shown, const Truth& truth, double size) {
  const ToneMapping tone{.exposure = exposureFor(truth.mean)};
  Gallery gallery{.title = formatLength(size), .columns = int(shown.size()) + 1};
  addRow(studio, gallery, shown, truth, false, tone);
  const std::string name = fmt::format("walk-{:g}mm", size);
  gallery.pictures[shown.size()] = {studio.show(name, truth.mean, tone), name + "-first.exr", "walk",
                                    fmt::format("noise {}, {:.2g} s", percent(truth.noise), truth.seconds)};
  addRow(studio, gallery, shown, truth, true, tone);
  gallery.caption = fmt::format("Exposure {:+.2f} stops.", tone.exposure);
  return gallery;
}

/// All methods at one size: rows of the table, and the gallery.
void makeSize(Studio& studio, Report& report, Table& table, const Figure& figure, double size) {
  const std::string text = fmt::format("{:g}mm", size);
  const Scene scene = sceneOf(studio, figure, size);
  const Truth truth = truthOf(studio, "walk-" + text, scene, walkSettings(studio));
  const double exposure = exposureFor(truth.mean);
  std::vector<Shown> shown;
  for (const MethodColumn& column : figure.methods) {
    Shown s{.file = column.name + "-" + text, .label = column.label};
    s.picture = studio.picture(s.file, scene, settingsOf(studio, column), Studio::Timing::kFrames);
    s.score = scoreOf(s.picture, truth, exposure);
    s.gained = scaled(s.picture, s.score.gain);
    std::vector<Cell> row{size, column.label};
    for (Cell& cell : scoreCells(s.score)) row.push_back(std::move(cell));
    table.rows.push_back(std::move(row));
    shown.push_back(std::move(s));
  }
  table.rows.push_back({size, "walk", "", truth.noise, "", "", "", "", "", truth.seconds});
  report.blocks.push_back(galleryOf(studio, shown, truth, size));
}

void makeFigure(Studio& studio, Report& report, const Figure& figure) {
  const RenderSettings settings = settingsOf(studio, {});
  report.blocks.push_back(
      Paragraph{fmt::format("{} in {}, parallel light from azimuth {:g}, elevation {:g} degrees (0 is the "
                            "camera's side, 180 behind the object), "
                            "{} x {} pixels, map {} x {}, all components.",
                            figure.model, figure.material, figure.light.azimuth, figure.light.elevation,
                            settings.width, settings.height, settings.mapSize, settings.mapSize)});
  Table table{.name = "errors",
              .caption =
                  "Against the walk over the pixels that are covered whole, R, G, B together. The walk is "
                  "made twice and "
                  "mean squares are of (M - T1)(M - T2), so that its noise does not add to the RMSE (it does "
                  "to FLIP); ± "
                  "is the standard error that it leaves, in the walk's own rows its noise. Time: of "
                  "real-time methods the "
                  "median of three frames in which all but the mesh changes, reading back included, on the "
                  "device above; "
                  "of the others one picture on the CPU.",
              .columns = {{"size, mm", "size_mm", 1}, {"method", "method"}}};
  for (Column& column : scoreColumns()) table.columns.push_back(column);
  for (const double size : kSizes) makeSize(studio, report, table, figure, size);
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
  return int(std::size(kSizes) * (comparedMethods().size() + 2));
}

int figure8Steps(const Studio&) {
  return int(std::size(kSizes) * (comparedMethods().size() + 3));
}

void makeFigure7(Studio& studio, Report& report) {
  makeFigure(studio, report, figure7());
}

void makeFigure8(Studio& studio, Report& report) {
  makeFigure(studio, report, figure8());
}

}  // namespace lychnite::paper
