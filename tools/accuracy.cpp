// Makes the tables and pictures of docs/accuracy.md: how far methods are from the walk, over models, sizes
// and materials. The walk is rendered twice, independently, so that its noise is not counted as error.
//
// Usage: accuracy --references DIR [--models DIR] [--methods a,b,...] [--pictures DIR] [--sheets DIR]
//   > tables.md
//   --references  the walk's pictures and the scores are kept there, and found again
//   --models      folder of bunny_filled.ply, spot.ply and nefertiti.ply; others are left out, and named
//   --methods     profiles (summed by `hierarchical`) and methods; default: the four profiles
//   --pictures    also writes the pictures side by side
//   --sheets      only writes a picture for each shape: the walk and the methods at 3, 30 and 300 mm
//   --made yes    only prints the scores that are kept; cells without one are shown as "-"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

#include "lychnite/app/image_maker.h"
#include "lychnite/base/atomic_file.h"
#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/image/io.h"
#include "lychnite/image/metrics.h"
#include "lychnite/image/montage.h"
#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene_file.h"

namespace {

using namespace lychnite;
namespace fs = std::filesystem;

constexpr double kSizes[] = {1, 3, 10, 30, 100, 300};
constexpr const char* kMaterials[] = {"fig6", "marble", "skin1", "wholemilk", "skimmilk"};
constexpr const char* kModels[] = {"sphere", "figurine", "bunny_filled", "nefertiti"};
constexpr ParallelLight kLight{.azimuth = 150, .elevation = 20};
constexpr int kResolution = 80;
constexpr double kMostError = 0.1;  // standard error of a relative RMSE that joins the means
constexpr double kSecondsOfAHalf = 12, kNoiseOfAHalf = 0.06;  // whichever comes first

/// A method under test, and what it is held against: a whole radiosity, or the radiance of orders two and up.
struct Column {
  std::string name;
  Method method = Method::kHierarchical;
  ProfileKind profile = ProfileKind::kDipole;
  bool fromSecond = false;
};

Column columnOf(const std::string& name) {
  for (const ProfileKind kind : {ProfileKind::kDipole, ProfileKind::kBetterDipole,
                                 ProfileKind::kNormalizedDiffusion, ProfileKind::kTabulated})
    if (name == profileName(kind))
      return {name, Method::kHierarchical, kind, kind == ProfileKind::kBetterDipole};
  if (name == "tabulated-two-up") return {name, Method::kHierarchical, ProfileKind::kTabulated, true};
  return {name, parseMethod(name, "--methods"), ProfileKind::kDipole, false};
}

struct Cell {
  std::string model, material;
  double size;
  std::string name() const { return fmt::format("{}-{}-{}mm", model, material, size); }
};

/// Relative RMSE over the fully covered pixels, its standard error, and the relative error of the mean.
struct Accuracy {
  double rmse = 0, error = 0, bias = 0;
};

/// What is compared in a picture: a layer, one value a pixel.
std::vector<glm::dvec3> valuesOf(const Image& image, const std::string& layer) {
  std::vector<glm::dvec3> values(image.pixelCount());
  for (size_t i = 0; i < values.size(); ++i) values[i] = glm::dvec3(image.rgb(i, layer));
  return values;
}

/// Mean square error by the halves' independent noise, (M - T1)(M - T2), and its own deviation by theirs.
Accuracy accuracyOf(const std::vector<glm::dvec3>& m, const Image& first, const Image& second,
                    const std::string& layer) {
  double squares = 0, variance = 0, truth = 0, sum = 0, count = 0;
  const std::vector<float>& alpha = first.channel("A");
  for (size_t i = 0; i < m.size(); ++i) {
    if (alpha[i] < 1) continue;
    double deviation = 0;
    for (int c = 0; c < 3; ++c) {
      const double a = double(first.rgb(i, layer)[c]), b = double(second.rgb(i, layer)[c]);
      const double product = (m[i][c] - a) * (m[i][c] - b), noise = (a - b) * (a - b);
      squares += product;
      truth += 0.5 * (a + b);
      sum += m[i][c];
      deviation += std::sqrt(std::max(product, 0.0) * noise + noise * noise / 12);
    }
    variance += deviation * deviation;  // the channels share their photons
    count += 3;
  }
  const double mean = truth / count, mse = squares / count;
  const double rmse = std::sqrt(std::max(mse, 0.0));
  return {rmse / mean, std::sqrt(variance) / count / (2 * std::max(rmse, 1e-3 * mean)) / mean,
          sum / truth - 1};
}

class Study {
 public:
  Study(fs::path references, fs::path models)
      : references_(std::move(references)), models_(std::move(models)) {}

  /// False where the model is not to be had.
  bool has(const std::string& model) {
    if (objects_.contains(model)) return true;
    const fs::path file = models_ / (model + ".ply");
    const bool onDisk = !models_.empty() && fs::exists(file);
    if (!onDisk && (model == "bunny_filled" || model == "spot" || model == "nefertiti")) return false;
    objects_[model] = loadObject(onDisk ? file.string() : model);
    return true;
  }

  Scene sceneOf(const Cell& cell) const {
    Scene scene;
    scene.objects = {objects_.at(cell.model)};
    scene.objects[0].size = cell.size;
    scene.objects[0].material.medium = findMaterial(cell.material, "").coefficients;
    scene.lights = {kLight};
    return scene;
  }

  /// One half of the truth, of resolution `pixels`, from disk where it is.
  Image truth(const Cell& cell, int half, int pixels, double seconds, double noise, int threads = 1) {
    const fs::path path = references_ / fmt::format("{}-{}-{}.exr", cell.name(), pixels, half);
    if (fs::exists(path)) return readImage(path);
    RenderSettings settings = settingsOf(Method::kWalk, pixels);
    settings.aovs = {"radiosity"};
    settings.seed = uint64_t(half) + 1;
    settings.timeLimit = seconds;
    settings.noise = noise;
    settings.threads = threads;
    Image image = maker_.render(sceneOf(cell), settings);
    writeExr(image, path);
    return image;
  }

  /// What a column scores in a cell; kept beside the references, so that a study can be stopped and gone on
  /// with.
  Accuracy measure(const Cell& cell, const Column& column) {
    if (const auto kept = keptScore(cell, column)) return *kept;
    const Accuracy accuracy = measureAnew(cell, column);
    writeTextAtomically(scorePath(cell, column),
                        fmt::format("{} {} {}\n", accuracy.rmse, accuracy.error, accuracy.bias));
    return accuracy;
  }

  std::optional<Accuracy> keptScore(const Cell& cell, const Column& column) const {
    Accuracy accuracy;
    std::ifstream file(scorePath(cell, column));
    if (!(file >> accuracy.rmse >> accuracy.error >> accuracy.bias)) return {};
    return accuracy;
  }
  fs::path scorePath(const Cell& cell, const Column& column) const {
    return references_ / fmt::format("{}-{}.txt", cell.name(), column.name);
  }

  Accuracy measureAnew(const Cell& cell, const Column& column) {
    const Image first = truth(cell, 0, kResolution, kSecondsOfAHalf, kNoiseOfAHalf);
    const Image second = truth(cell, 1, kResolution, kSecondsOfAHalf, kNoiseOfAHalf);
    return accuracyOf(values(cell, column, kResolution), first, second, column.fromSecond ? "" : "radiosity");
  }

  /// What the column says where the truth has its radiosity, or its radiance of orders two and up.
  std::vector<glm::dvec3> values(const Cell& cell, const Column& column, int pixels) {
    RenderSettings settings = settingsOf(column.method, pixels);
    settings.profile = column.profile;
    const bool makesWhole = column.method == Method::kHierarchical || column.method == Method::kDipole ||
                            column.method == Method::kVolume;
    if (column.fromSecond) return valuesOf(maker_.render(sceneOf(cell), settings), "");
    if (makesWhole) {
      settings.components.multiple = false;
      settings.aovs = {"radiosity"};
      return valuesOf(maker_.render(sceneOf(cell), settings), "radiosity");
    }
    // A method that only gives radiance: back to radiosity by the exit lobe, which a judge's picture tells.
    std::vector<glm::dvec3> radiance = valuesOf(maker_.render(sceneOf(cell), settings), "");
    RenderSettings judge = settingsOf(Method::kHierarchical, pixels);
    judge.aovs = {"radiosity"};
    const Image both = maker_.render(sceneOf(cell), judge);
    for (size_t i = 0; i < radiance.size(); ++i) {
      const glm::vec3 L = both.rgb(i), B = both.rgb(i, "radiosity");
      const double lobe = double(L.x + L.y + L.z) / std::max(double(B.x + B.y + B.z), 1e-30);
      radiance[i] = lobe > 0 ? radiance[i] / lobe : glm::dvec3(0);
    }
    return radiance;
  }

 private:
  static RenderSettings settingsOf(Method method, int pixels) {
    RenderSettings settings;
    settings.width = settings.height = pixels;
    settings.method = method;
    settings.components = {.multiple = true, .single = false, .surface = false};
    return settings;
  }

  fs::path references_, models_;
  ImageMaker maker_{{}};
  std::map<std::string, Object> objects_;
};

using Results = std::map<std::pair<std::string, std::string>, Accuracy>;  // by column and cell

const Accuracy* find(const Results& results, const Column& column, const Cell& cell) {
  const auto found = results.find({column.name, cell.name()});
  return found == results.end() ? nullptr : &found->second;
}

std::string sizesRow() {
  std::string row;
  for (const double size : kSizes) row += fmt::format(" {} mm |", size);
  return row;
}

/// Means over models and materials of the cells that are known well enough, and how many these are; one row a
/// column of the study.
void printMeans(const char* title, const std::vector<Column>& columns, const std::vector<std::string>& models,
                const Results& results, auto value) {
  fmt::print("\n{}\n\n| |{}\n|-|-|-|-|-|-|-|\n", title, sizesRow());
  for (const Column& column : columns) {
    fmt::print("| {} |", column.name);
    for (const double size : kSizes) {
      double sum = 0, count = 0;
      for (const std::string& model : models)
        for (const char* material : kMaterials) {
          const Accuracy* a = find(results, column, {model, material, size});
          if (!a || a->error > kMostError) continue;
          sum += value(*a);
          count += 1;
        }
      if (count > 0)
        fmt::print(" {:.0f} ({}) |", 100 * sum / count, count);
      else
        fmt::print(" - |");
    }
    fmt::print("\n");
  }
}

void printCells(const Column& column, const std::vector<std::string>& models, const Results& results) {
  fmt::print("\n### {}\n\n| model | material |{}\n|-|-|-|-|-|-|-|-|\n", column.name, sizesRow());
  for (const std::string& model : models)
    for (const char* material : kMaterials) {
      fmt::print("| {} | {} |", model, material);
      for (const double size : kSizes) {
        if (const Accuracy* a = find(results, column, {model, material, size}))
          fmt::print(" {:.1f} ± {:.1f} ({:+.0f}) |", 100 * a->rmse, 100 * a->error, 100 * a->bias);
        else
          fmt::print(" - |");
      }
      fmt::print("\n");
    }
}

Image pictureOf(const std::vector<glm::dvec3>& values, const Image& like) {
  Image image(like.width(), like.height());
  image.addChannel("A") = like.channel("A");
  for (size_t i = 0; i < values.size(); ++i) image.setRgb(i, glm::vec3(values[i]));
  return image;
}

/// The walk and the columns at one exposure, then the columns' error maps.
std::vector<Image> picturesOf(Study& study, const Cell& cell, const std::vector<Column>& columns, int pixels,
                              double seconds) {
  const Image walk = study.truth(cell, 0, pixels, seconds, 0.02, 0);
  std::vector<Image> pictures{pictureOf(valuesOf(walk, "radiosity"), walk)};
  for (const Column& column : columns)
    pictures.push_back(pictureOf(study.values(cell, column, pixels), walk));
  std::vector<float> light;
  for (size_t i = 0; i < walk.pixelCount(); ++i)
    if (walk.channel("A")[i] == 1) light.push_back(pictures[0].rgb(i).y);
  std::nth_element(light.begin(), light.begin() + ptrdiff_t(light.size() * 98 / 100), light.end());
  const double exposure = std::log2(0.8 / std::max(double(light[light.size() * 98 / 100]), 1e-9));
  for (Image& picture : pictures)
    for (size_t i = 0; i < picture.pixelCount(); ++i)
      picture.setRgb(i, picture.rgb(i) * float(std::exp2(exposure)));
  for (size_t i = 1; i <= columns.size(); ++i) pictures.push_back(errorMap(pictures[i], pictures[0]));
  return pictures;
}

/// For each cell two rows: the walk and the columns, and their errors.
void writePictures(Study& study, const std::vector<Cell>& cells, std::vector<Column> columns, int pixels,
                   double seconds, const fs::path& path) {
  std::erase_if(columns, [](const Column& column) { return column.fromSecond; });
  std::vector<std::vector<Image>> rows;
  for (const Cell& cell : cells) {
    fmt::print(stderr, "\r{}    ", cell.name());
    rows.push_back(picturesOf(study, cell, columns, pixels, seconds));
  }
  const Image blank = pictureOf(std::vector<glm::dvec3>(size_t(pixels) * size_t(pixels)), rows[0][0]);
  std::vector<Panel> panels;
  for (size_t r = 0; r < cells.size(); ++r) {
    panels.push_back({&rows[r][0], fmt::format("walk, {} mm", cells[r].size)});
    for (size_t c = 0; c < columns.size(); ++c) panels.push_back({&rows[r][c + 1], columns[c].name});
    panels.push_back({&blank, "error, 0 to 50 %"});
    for (size_t c = 0; c < columns.size(); ++c) panels.push_back({&rows[r][columns.size() + 1 + c], ""});
  }
  writePng(montage(panels, {}, int(columns.size() + 1)), path);
}

/// One picture for each shape.
void writeSheets(Study& study, const std::vector<Column>& columns, const fs::path& folder) {
  constexpr int kPixels = 120;
  constexpr double kSeconds = 12;
  fs::create_directories(folder);
  for (const char* model : {"sphere", "slab", "figurine", "knot", "bunny_filled", "spot", "nefertiti"}) {
    if (!study.has(model)) continue;
    std::vector<Cell> cells;
    for (const double size : {3.0, 30.0, 300.0}) cells.push_back({model, "fig6", size});
    writePictures(study, cells, columns, kPixels, kSeconds, folder / fmt::format("{}.png", model));
  }
}

struct Arguments {
  fs::path references, models, pictures, sheets;
  bool made = false;
  std::string methods = "dipole,better-dipole,normalized-diffusion,tabulated";
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string flag = argv[i];
    if (flag == "--references") arguments.references = argv[i + 1];
    if (flag == "--models") arguments.models = argv[i + 1];
    if (flag == "--pictures") arguments.pictures = argv[i + 1];
    if (flag == "--sheets") arguments.sheets = argv[i + 1];
    if (flag == "--made") arguments.made = true;
    if (flag == "--methods") arguments.methods = argv[i + 1];
  }
  if (arguments.references.empty())
    throw Error({.where = "--references", .expected = "a folder", .found = "none", .todo = ""},
                Error::Kind::kUsage);
  fs::create_directories(arguments.references);
  return arguments;
}

void run(const Arguments& arguments) {
  std::vector<Column> columns;
  for (const std::string& name : split(arguments.methods, ',')) columns.push_back(columnOf(name));
  Study study(arguments.references, arguments.models);
  if (!arguments.sheets.empty()) return writeSheets(study, columns, arguments.sheets);
  std::vector<std::string> models;
  for (const char* model : kModels) {
    if (study.has(model))
      models.emplace_back(model);
    else
      fmt::print(stderr, "{}: not in --models, left out\n", model);
  }
  Results results;
  size_t done = 0;
  const size_t all = models.size() * std::size(kMaterials) * std::size(kSizes);
  for (const std::string& model : models)
    for (const char* material : kMaterials)
      for (const double size : kSizes) {
        const Cell cell{model, material, size};
        for (const Column& column : columns) {
          const auto score = arguments.made ? study.keptScore(cell, column) : study.measure(cell, column);
          if (score) results[{column.name, cell.name()}] = *score;
        }
        fmt::print(stderr, "\r{}/{} {}    ", ++done, all, cell.name());
      }
  printMeans("Relative RMSE in %, mean over models and materials:", columns, models, results,
             [](const Accuracy& a) { return a.rmse; });
  printMeans("Error of the mean in % (below 0: too dark), mean over models and materials:", columns, models,
             results, [](const Accuracy& a) { return a.bias; });
  for (const Column& column : columns) printCells(column, models, results);
  if (arguments.pictures.empty()) return;
  fs::create_directories(arguments.pictures);
  for (const Cell& cell : {Cell{"figurine", "fig6", 3}, Cell{"figurine", "skin1", 10},
                           Cell{"bunny_filled", "fig6", 10}, Cell{"bunny_filled", "marble", 30}})
    if (study.has(cell.model))
      writePictures(study, {cell}, columns, 160, 30, arguments.pictures / (cell.name() + ".png"));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse(argc, argv));
  } catch (const Error& error) {
    fmt::print(stderr, "accuracy: {}\n", error.what());
    return 1;
  }
}
