// Makes the tables of docs/sampling.md: relative RMSE of the multiple-scattering component of the light-space
// samplers against the judge, over models, materials, six sizes and three lights, one of them from behind.
// Usage: sampling_table [--materials LIST] [--judge dipole|hierarchical] MODEL... > table.md
// (built-in names or files; some minutes a model)
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "lychnite/app/image_maker.h"
#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/image/metrics.h"
#include "lychnite/scene/scene_file.h"
#include "sampling_cells.h"

namespace {

using namespace lychnite;
using namespace lychnite::sampling;

constexpr size_t kSizeCount = std::size(kSizes);

struct Row {
  const char* name;
  Method method;
  int samples;
};
constexpr Row kRows[] = {{"adaptive", Method::kAdaptive, 32},
                         {"matched, 16", Method::kMatched, 16},
                         {"matched, 32", Method::kMatched, 32},
                         {"matched, 48", Method::kMatched, 48},
                         {"matched, 96", Method::kMatched, 96}};

/// Relative errors of one row over the cells of one size.
struct Cells {
  double sum = 0, worst = 0, gained = 0;
  int count = 0;
  void add(const Metrics& m) {
    sum += m.relative_rmse;
    gained += m.relative_rmse_after_gain;
    worst = std::max(worst, m.relative_rmse);
    ++count;
  }
  void add(const Cells& other) {
    sum += other.sum;
    gained += other.gained;
    worst = std::max(worst, other.worst);
    count += other.count;
  }
};

/// Errors of every row at every size.
struct Table {
  Cells cells[std::size(kRows)][kSizeCount];
  void add(const Table& other) {
    for (size_t r = 0; r < std::size(kRows); ++r)
      for (size_t s = 0; s < kSizeCount; ++s) cells[r][s].add(other.cells[r][s]);
  }
};

void print(const std::string& title, const Table& table) {
  fmt::print(
      "\n### {}\n\n| method | 1 mm | 3 mm | 10 mm | 30 mm | 100 mm | 300 mm | mean | after gain |\n"
      "|-|-|-|-|-|-|-|-|-|\n",
      title);
  for (size_t r = 0; r < std::size(kRows); ++r) {
    fmt::print("| {} |", kRows[r].name);
    Cells all;
    for (const Cells& cell : table.cells[r]) {
      if (cell.count > 0)
        fmt::print(" {:.1f} ({:.1f}) |", 100 * cell.sum / cell.count, 100 * cell.worst);
      else
        fmt::print(" dark |");
      all.add(cell);
    }
    if (all.count > 0)
      fmt::print(" {:.1f} | {:.1f} |\n", 100 * all.sum / all.count, 100 * all.gained / all.count);
    else
      fmt::print(" - | - |\n");
  }
  std::fflush(stdout);
}

Table measure(ImageMaker& maker, Method judge, const Object& object,
              const std::vector<std::string>& materials, const NamedLight& light, const std::string& name) {
  Table table;
  for (const std::string& material : materials)
    for (size_t s = 0; s < kSizeCount; ++s) {
      const Scene scene = sceneOf(object, material, kSizes[s], light.light);
      const Image reference = maker.render(scene, settingsOf(judge));
      if (isBlack(reference)) continue;
      for (size_t r = 0; r < std::size(kRows); ++r)
        table.cells[r][s].add(
            compare(maker.render(scene, settingsOf(kRows[r].method, kRows[r].samples)), reference).together);
      fmt::print(stderr, "\r{}, {}: {} {} mm      ", name, light.name, material, kSizes[s]);
    }
  return table;
}

void run(Method judge, const std::vector<std::string>& materials, const std::vector<std::string>& models) {
  ImageMaker maker({});
  std::map<std::string, Table> lights;
  Table all;
  for (const std::string& model : models) {
    const Object object = loadObject(model);
    const std::string name = model.substr(model.find_last_of('/') + 1);
    for (const NamedLight& light : kLights) {
      const Table table = measure(maker, judge, object, materials, light, name);
      print(fmt::format("{}, light from {}", name, light.name), table);
      lights[light.name].add(table);
      all.add(table);
    }
  }
  for (const auto& [name, table] : lights) print("All models, light from " + name, table);
  print("Everything", all);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Method judge = Method::kHierarchical;
    std::vector<std::string> materials{"fig6", "marble", "skin1", "wholemilk", "skimmilk", "ketchup"}, models;
    for (int i = 1; i < argc; ++i) {
      const std::string flag = argv[i];
      if (flag == "--materials" && i + 1 < argc)
        materials = split(argv[++i], ',');
      else if (flag == "--judge" && i + 1 < argc)
        judge = parseMethod(argv[++i], "--judge");
      else
        models.push_back(flag);
    }
    run(judge, materials, models);
  } catch (const Error& error) {
    fmt::print(stderr, "sampling_table: {}\n", error.what());
    return 1;
  }
}
