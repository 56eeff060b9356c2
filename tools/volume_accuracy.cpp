// Makes the table of docs/accuracy.md that holds `volume` and the dipole to the walk on all of the surface:
// relative RMSE of the whole radiosity over patches of equal area, and the mean of the whole surface as unit.
// The walk is traced in two independent halves, so that its noise is not counted as error.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>

#include "lychnite/base/atomic_file.h"
#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/base/units.h"
#include "lychnite/image/io.h"
#include "lychnite/mesh/builtin.h"
#include "lychnite/mesh/load.h"
#include "lychnite/optics/materials.h"
#include "lychnite/reference/surface_walk.h"
#include "lychnite/scene/scene_file.h"
#include "lychnite/volume/volume.h"
#include "reference/hierarchical.h"

namespace {

using namespace lychnite;
namespace fs = std::filesystem;

constexpr size_t kFine = 4000, kCoarse = 400;  // patches; a coarse one is ten fine ones
constexpr size_t kPointsEach = 8;              // of a fine patch, where a method is asked
constexpr double kAsked = 0.06, kAskedFirst = 0.1;
constexpr double kMostUncertain = 0.03;  // standard error of a score that joins the means

std::atomic<bool> stopped = false;

/// What a column asks of volume: "volume[:CELLS[:PASSES]]", or "first[:CELLS]", a picture without photons as
/// a window in motion shows it. 0 cells for the default.
struct VolumeColumn {
  int cells = 0, passes = RenderSettings{}.passes;

  explicit VolumeColumn(const std::string& column) {
    const auto parts = split(column, ':');
    const bool first = parts[0] == "first";
    if (!first && parts[0] != "volume")
      throw Error({.where = "--columns",
                   .expected = "volume[:CELLS[:PASSES]], first[:CELLS] or dipole",
                   .found = "'" + column + "'",
                   .todo = {}},
                  Error::Kind::kUsage);
    if (first) passes = 0, cells = kLiveVolumeCells;
    if (parts.size() > 1) cells = int(parseNumber(parts[1], "--columns"));
    if (parts.size() > 2) passes = int(parseNumber(parts[2], "--columns"));
  }
  bool isFirst() const { return passes == 0; }
};

/// 0.12 x 1 x 0.7 with edges of radius 0.04.
std::shared_ptr<const Mesh> roundedPlate() {
  constexpr int n = 64;
  const glm::vec3 half(0.06f, 0.5f, 0.35f);
  constexpr float radius = 0.04f;
  // Lines of the raster crowd in the edges.
  const auto line = [](int i, float extent) {
    const float t = 2 * float(i) / n - 1, edge = 0.375f, flat = extent - radius;
    const float a = std::abs(t),
                b = a < 1 - edge ? a / (1 - edge) * flat : flat + (a - 1 + edge) / edge * radius;
    return std::copysign(b, t);
  };
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      const auto first = uint32_t(mesh.positions.size());
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
          glm::vec3 q;
          q[axis] = side * half[axis];
          q[u] = line(i, half[u]);
          q[v] = line(j, half[v]);
          const glm::vec3 inner = glm::clamp(q, radius - half, half - radius);
          mesh.positions.push_back(inner + radius * glm::normalize(q - inner));
        }
      for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
          const uint32_t a = first + j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
          if (side > 0)
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
          else
            mesh.triangles.insert(mesh.triangles.end(), {{a, d, b}, {a, c, d}});
        }
    }
  return repairMesh(std::move(mesh), "plate").mesh;
}

struct Cell {
  std::string shape, material, light;
  double size = 1, g = 0;
  std::string name() const {
    return fmt::format("{}-{}-{}mm-{}{}", shape, material, size, light, g > 0 ? fmt::format("-g{}", g) : "");
  }
};

ParallelLight lightOf(const std::string& name) {
  if (name == "front") return {.azimuth = -40, .elevation = 35};
  if (name == "side") return {.azimuth = 100, .elevation = 20};
  if (name == "behind") return {.azimuth = 150, .elevation = 20};
  throw Error(
      {.where = "--lights", .expected = "front, side or behind", .found = "'" + name + "'", .todo = {}},
      Error::Kind::kUsage);
}

using Values = std::vector<Rgb>;  // of the fine patches

Values coarse(const Values& fine) {
  Values result(kCoarse, Rgb(0));
  for (size_t i = 0; i < fine.size(); ++i)
    result[i * kCoarse / fine.size()] += fine[i] * (double(kCoarse) / double(fine.size()));
  return result;
}

/// Relative RMSE, of one picture with the noise that it has; its standard error, by the truth's noise; the
/// same with a method's own noise left out, by two independent pictures; and the error of the mean.
struct Score {
  double rmse = 0, error = 0, quiet = 0, bias = 0;
};

Score scoreOf(const std::array<Values, 2>& m, const std::array<Values, 2>& t) {
  double one = 0, quiet = 0, variance = 0, truth = 0, sum = 0, count = 0;
  for (size_t i = 0; i < t[0].size(); ++i) {
    double deviation = 0;
    for (int c = 0; c < 3; ++c) {
      const double a = t[0][i][c], b = t[1][i][c], noise = (a - b) * (a - b);
      double own = 0;
      for (const Values& model : m) own += 0.5 * (model[i][c] - a) * (model[i][c] - b);
      one += own;
      quiet += 0.5 * ((m[0][i][c] - a) * (m[1][i][c] - b) + (m[1][i][c] - a) * (m[0][i][c] - b));
      deviation += std::sqrt(std::max(own, 0.0) * noise + noise * noise / 12);  // channels share photons
      truth += 0.5 * (a + b);
      sum += 0.5 * (m[0][i][c] + m[1][i][c]);
      count += 1;
    }
    variance += deviation * deviation;
  }
  const double mean = truth / count, rmse = std::sqrt(std::max(one / count, 0.0));
  return {rmse / mean, std::sqrt(variance) / count / (2 * std::max(rmse, 1e-3 * mean)) / mean,
          std::sqrt(std::max(quiet / count, 0.0)) / mean, sum / truth - 1};
}

struct Scores {
  Score fine, coarse;
};

class Study {
 public:
  Study(fs::path references, fs::path models, double seconds)
      : references_(std::move(references)), models_(std::move(models)), seconds_(seconds) {}

  /// False where the model is not to be had.
  bool has(const std::string& shape) {
    if (objects_.contains(shape)) return true;
    const fs::path file = models_ / (shape + ".ply");
    if (shape == "plate") {
      objects_[shape] = {.name = "plate", .mesh = roundedPlate()};
      return true;
    }
    const bool onDisk = !models_.empty() && fs::exists(file);
    if (!onDisk && !builtinMesh(shape)) return false;
    objects_[shape] = loadObject(onDisk ? file.string() : shape);
    return true;
  }

  fs::path truthPath(const Cell& cell) const { return references_ / (cell.name() + ".exr"); }

  /// Both halves of the truth, from disk where they are.
  std::array<Values, 2> truth(const Cell& cell) {
    const fs::path path = truthPath(cell);
    if (!fs::exists(path)) writeExr(walk(cell), path);
    const Image image = readImage(path);
    std::array<Values, 2> halves;
    for (size_t half : {0, 1})
      for (size_t i = 0; i < kFine; ++i) halves[half].push_back(Rgb(image.rgb(half * kFine + i)));
    return halves;
  }

  std::optional<Scores> kept(const Cell& cell, const std::string& column) const {
    std::ifstream file(scorePath(cell, column));
    Scores s;
    for (Score* score : {&s.fine, &s.coarse})
      if (!(file >> score->rmse >> score->error >> score->quiet >> score->bias)) return {};
    return s;
  }

  Scores measure(const Cell& cell, const std::string& column) {
    const auto t = truth(cell);
    const auto m = valuesOf(cell, column);
    const Scores s{scoreOf(m, t), scoreOf({coarse(m[0]), coarse(m[1])}, {coarse(t[0]), coarse(t[1])})};
    std::string text;
    for (const Score* score : {&s.fine, &s.coarse})
      text += fmt::format("{} {} {} {}\n", score->rmse, score->error, score->quiet, score->bias);
    writeTextAtomically(scorePath(cell, column), text);
    return s;
  }

 private:
  fs::path scorePath(const Cell& cell, const std::string& column) const {
    return references_ / fmt::format("{}-{}.txt", cell.name(), column);
  }

  Scene sceneOf(const Cell& cell) const {
    Scene scene;
    scene.objects = {objects_.at(cell.shape)};
    scene.objects[0].size = cell.size;
    Coefficients& medium = scene.objects[0].material.medium;
    medium = findMaterial(cell.material, "--materials").coefficients;
    medium.sigma_s = medium.sigma_sp() / (1 - cell.g);
    medium.g = cell.g;
    scene.lights = {lightOf(cell.light)};
    return scene;
  }

  /// A picture of one row for each half, one pixel a patch.
  Image walk(const Cell& cell) const {
    const SurfaceWalkResult result =
        surfaceWalk(sceneOf(cell), {.patches = kFine, .timeLimit = seconds_}, progress());
    Image image(int(kFine), 2);
    for (size_t half : {0, 1})
      for (size_t i = 0; i < kFine; ++i)
        image.setRgb(half * kFine + i, glm::vec3(result.radiosity[half][0][i]));
    image.metadata["photons"] = fmt::format("{}", result.photons);
    return image;
  }

  static Progress progress() {
    return Progress([](const Progress::Update&) { return !stopped.load(); });
  }

  /// Two independent estimates, the same where a method has no noise.
  std::array<Values, 2> valuesOf(const Cell& cell, const std::string& column) {
    const Scene scene = sceneOf(cell);
    const std::vector<MeshPoint> points = patchPoints(scene, 0, kFine, kPointsEach);
    if (column == "dipole") {
      const Values values = patchMeans(dipoleAt(scene, points));
      return {values, values};
    }
    const VolumeColumn asked(column);
    std::array<Values, 2> result;
    for (size_t half : {0, 1}) {
      VolumeSolver solver;
      const int cells = asked.cells > 0 ? asked.cells : volumeCells(scene);
      solver.update(scene, {.cells = cells, .seed = half + 1}, progress());
      for (int pass = 0; pass < asked.passes; ++pass) solver.refine(progress());
      result[half] = patchMeans(solver.pointRadiosity(0, points, VolumeSolver::Orders::kAll));
      if (!asked.isFirst()) continue;
      result[1] = result[0];
      break;
    }
    return result;
  }

  static std::vector<glm::vec3> dipoleAt(const Scene& scene, const std::vector<MeshPoint>& points) {
    const RayScene rays(scene);
    CameraReceivers receivers;
    for (const MeshPoint& point : points) {
      Receiver receiver;
      receiver.hit = rays.hitOf(0, point.triangle, point.u, point.v, 0);
      receiver.normal = receiver.hit.normal;
      receivers.receivers.push_back(receiver);
    }
    return sumHierarchical(rays, receivers, {}, {}, progress()).radiosity;
  }

  static Values patchMeans(const std::vector<glm::vec3>& atPoints) {
    Values values(kFine, Rgb(0));
    for (size_t i = 0; i < atPoints.size(); ++i)
      values[i / kPointsEach] += Rgb(atPoints[i]) / double(kPointsEach);
    return values;
  }

  fs::path references_, models_;
  double seconds_;
  std::map<std::string, Object> objects_;
};

struct Arguments {
  fs::path references, models;
  std::string shapes = "sphere,plate,figurine,bunny_filled,spot,nefertiti,knot";
  std::string materials = "fig6,marble,skin1,wholemilk,skimmilk,ketchup";
  std::string sizes = "1,3,10,30,100,300", lights = "front,side,behind", columns = "volume,first,dipole";
  double g = 0, seconds = 4;
  bool onlyReferences = false, noWalks = false, made = false;
};

using Results = std::map<std::pair<std::string, std::string>, Scores>;  // by column and cell

class Tables {
 public:
  Tables(const Arguments& arguments, const std::vector<Cell>& cells, const Results& results)
      : arguments_(arguments), cells_(cells), results_(results) {}

  void print() const {
    for (const std::string& column : split(arguments_.columns, ',')) {
      printMeans(column, "400 patches", &Scores::coarse);
      printMeans(column, "4000 patches", &Scores::fine);
    }
    for (const std::string& column : split(arguments_.columns, ',')) printCells(column);
    for (const std::string& column : split(arguments_.columns, ',')) printMisses(column);
  }

 private:
  const Scores* find(const std::string& column, const Cell& cell) const {
    const auto found = results_.find({column, cell.name()});
    return found == results_.end() ? nullptr : &found->second;
  }

  struct Mean {
    double sum = 0, quiet = 0, worst = 0, count = 0;
    void add(const Score& s) {
      if (s.error > kMostUncertain) return;
      sum += s.rmse, quiet += s.quiet, count += 1;
      worst = std::max(worst, s.rmse);
    }
    std::string text() const {
      if (count == 0) return "-";
      return fmt::format("{:.1f} [{:.1f}] ({:.1f}, {})", 100 * sum / count, 100 * quiet / count, 100 * worst,
                         count);
    }
  };

  void printMeans(const std::string& column, const char* unit, Score Scores::*which) const {
    fmt::print("\n**{}**, {}\n\n| |", column, unit);
    const auto sizes = split(arguments_.sizes, ',');
    for (const std::string& size : sizes) fmt::print(" {} mm |", size);
    fmt::print(" all |\n|-|");
    for (size_t i = 0; i <= sizes.size(); ++i) fmt::print("-|");
    fmt::print("\n");
    auto lights = split(arguments_.lights, ',');
    lights.emplace_back("all");
    for (const std::string& light : lights) {
      fmt::print("| {} |", light);
      for (size_t s = 0; s <= sizes.size(); ++s) {
        Mean mean;
        for (const Cell& cell : cells_) {
          const bool here = (light == "all" || cell.light == light) &&
                            (s == sizes.size() || cell.size == std::stod(sizes[s]));
          if (const Scores* scores = here ? find(column, cell) : nullptr) mean.add(scores->*which);
        }
        fmt::print(" {} |", mean.text());
      }
      fmt::print("\n");
    }
  }

  void printCells(const std::string& column) const {
    fmt::print("\n**{}**, 400 patches, {}\n\n| shape | material |", column, arguments_.lights);
    const auto sizes = split(arguments_.sizes, ',');
    for (const std::string& size : sizes) fmt::print(" {} mm |", size);
    fmt::print("\n|-|-|");
    for (size_t i = 0; i < sizes.size(); ++i) fmt::print("-|");
    fmt::print("\n");
    for (const std::string& shape : split(arguments_.shapes, ','))
      for (const std::string& material : split(arguments_.materials, ',')) {
        fmt::print("| {} | {} |", shape, material);
        for (const std::string& size : sizes) {
          std::string text;
          for (const std::string& light : split(arguments_.lights, ',')) {
            const Scores* s = find(column, {shape, material, light, std::stod(size), arguments_.g});
            text += fmt::format("{}{}", text.empty() ? "" : " / ",
                                s ? fmt::format("{:.1f}", 100 * s->coarse.rmse) : "-");
          }
          fmt::print(" {} |", text);
        }
        fmt::print("\n");
      }
  }

  void printMisses(const std::string& column) const {
    if (column == "dipole") return;
    const bool first = VolumeColumn(column).isFirst();
    const double asked = first ? kAskedFirst : kAsked;
    fmt::print("\n**{}** above {:.0f} %{}, 400 patches:\n\n", column, 100 * asked,
               first ? " from 10 mm up" : "");
    size_t found = 0, all = 0;
    for (const Cell& cell : cells_) {
      const Scores* s = first && cell.size < 10 ? nullptr : find(column, cell);
      if (!s) continue;
      ++all;
      if (s->coarse.rmse <= asked) continue;
      ++found;
      fmt::print("- {}: {:.1f} ± {:.1f} % (without its noise {:.1f}, mean {:+.1f})\n", cell.name(),
                 100 * s->coarse.rmse, 100 * s->coarse.error, 100 * s->coarse.quiet, 100 * s->coarse.bias);
    }
    fmt::print("{} of {} cells.\n", found, all);
  }

  const Arguments& arguments_;
  const std::vector<Cell>& cells_;
  const Results& results_;
};

/// All cells, in an order that is the same each time but has every corner of the table early.
std::vector<Cell> cellsOf(const Arguments& arguments, Study& study) {
  std::vector<Cell> cells;
  for (const std::string& shape : split(arguments.shapes, ',')) {
    if (!study.has(shape)) {
      fmt::print(stderr, "{}: not in --models, left out\n", shape);
      continue;
    }
    for (const std::string& material : split(arguments.materials, ','))
      for (const std::string& size : split(arguments.sizes, ','))
        for (const std::string& light : split(arguments.lights, ',')) {
          findMaterial(material, "--materials");
          lightOf(light);
          cells.push_back({shape, material, light, std::stod(size), arguments.g});
        }
  }
  const auto place = [](const Cell& cell) { return std::hash<std::string>{}(cell.name()); };
  std::sort(cells.begin(), cells.end(), [&](const Cell& a, const Cell& b) { return place(a) < place(b); });
  return cells;
}

void run(const Arguments& arguments) {
  for (const std::string& column : split(arguments.columns, ','))
    if (column != "dipole") VolumeColumn{column};
  fs::create_directories(arguments.references);
  Study study(arguments.references, arguments.models, arguments.seconds);
  const std::vector<Cell> cells = cellsOf(arguments, study);
  Results results;
  size_t done = 0;
  for (const Cell& cell : cells) {
    if (!arguments.made) fmt::print(stderr, "\r{}/{} {}          ", ++done, cells.size(), cell.name());
    if (arguments.onlyReferences) {
      study.truth(cell);
      continue;
    }
    for (const std::string& column : split(arguments.columns, ',')) {
      auto scores = study.kept(cell, column);
      const bool measures = !arguments.made && (!arguments.noWalks || fs::exists(study.truthPath(cell)));
      if (!scores && measures) scores = study.measure(cell, column);
      if (scores) results[{column, cell.name()}] = *scores;
    }
  }
  if (!arguments.onlyReferences) Tables(arguments, cells, results).print();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How far volume's and the dipole's radiosity is from the walk's on all of the surface");
  Arguments a;
  app.add_option("--references", a.references,
                 "folder where the walk's patches and the scores are kept, and found")
      ->required();
  app.add_option("--models", a.models, "folder of bunny_filled.ply, spot.ply, nefertiti.ply, ...");
  app.add_option("--shapes", a.shapes, "built-in models, plate, or files of --models without .ply")
      ->capture_default_str();
  app.add_option("--materials", a.materials, "names of lychnite materials")->capture_default_str();
  app.add_option("--sizes", a.sizes, "mm")->capture_default_str();
  app.add_option("--lights", a.lights, "front, side, behind")->capture_default_str();
  app.add_option("--columns", a.columns, "volume[:CELLS[:PASSES]], first[:CELLS] (its first picture), dipole")
      ->capture_default_str();
  app.add_option("--g", a.g, "anisotropy, with the material's sigma_sp")->check(CLI::Range(0.0, 0.95));
  app.add_option("--seconds", a.seconds, "of the walk for a cell, both halves")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--only-references", a.onlyReferences, "make what is missing of the walk's patches");
  app.add_flag("--no-walks", a.noWalks, "leave out cells whose patches are not there");
  app.add_flag("--made", a.made, "print the scores that are kept, measure nothing");
  CLI11_PARSE(app, argc, argv);
  std::signal(SIGINT, [](int) { stopped = true; });
  try {
    run(a);
  } catch (const Interrupted&) {
    fmt::print(stderr, "\ninterrupted; what was measured is kept\n");
    return 130;
  } catch (const Error& error) {
    fmt::print(stderr, "volume_accuracy: {}\n", error.what());
    return error.kind() == Error::Kind::kUsage ? 2 : 1;
  }
}
