#include "tables.h"

#include <fmt/format.h>

#include <algorithm>

namespace lychnite::accuracy {

namespace {

constexpr double kAsked = 0.06, kAskedFirst = 0.1, kAskedFirstFrom = 10;

class Tables {
 public:
  Tables(const Choice& choice, const TablePlan& plan, const Results& results)
      : choice_(choice), plan_(plan), results_(results) {}

  void print() const {
    fmt::print("Relative RMSE in %. Means: one picture [without its own noise] (worst cell, cells).\n");
    for (const std::string& column : plan_.columns)
      for (size_t r = plan_.resolutions.size(); r-- > 0;) printMeans(column, r);
    fmt::print("\nEvery cell: one picture ± what the truth's noise leaves (error of the mean), {}.\n",
               fmt::join(choice_.lights, " / "));
    for (const std::string& column : plan_.columns) printCells(column);
    for (const std::string& column : plan_.columns) printMisses(column);
  }

 private:
  const Scores* find(const std::string& column, const Cell& cell) const {
    const auto found = results_.find({column, cell});
    return found == results_.end() ? nullptr : &found->second;
  }

  void printHead(const std::string& first, const char* last) const {
    fmt::print("{}", first);
    for (const double size : choice_.sizes) fmt::print(" {} mm |", size);
    fmt::print("{}\n|", last);
    const auto bars = std::ranges::count(first, '|') - 1 + long(choice_.sizes.size()) + (*last ? 1 : 0);
    for (long i = 0; i < bars; ++i) fmt::print("-|");
    fmt::print("\n");
  }

  /// Over the cells for which `holds`.
  template <class Holds>
  std::string meanText(const std::string& column, size_t resolution, Holds holds) const {
    double sum = 0, quiet = 0, worst = 0, count = 0;
    for (const auto& [key, scores] : results_) {
      const Score& s = scores[resolution];
      if (key.first != column || !holds(key.second) || s.error > plan_.mostUncertain) continue;
      sum += s.rmse;
      quiet += s.quiet;
      worst = std::max(worst, s.rmse);
      count += 1;
    }
    if (count == 0) return "-";
    return fmt::format("{:.1f} [{:.1f}] ({:.1f}, {})", 100 * sum / count, 100 * quiet / count, 100 * worst,
                       count);
  }

  void printMeans(const std::string& column, size_t resolution) const {
    fmt::print("\n**{}**, {}\n\n", column, plan_.resolutions[resolution]);
    printHead("| |", " all |");
    std::vector<std::string> lights = choice_.lights;
    lights.emplace_back("all");
    for (const std::string& light : lights) {
      fmt::print("| {} |", light);
      const auto lit = [&](const Cell& cell) { return light == "all" || cell.light == light; };
      for (const double size : choice_.sizes)
        fmt::print(" {} |", meanText(column, resolution,
                                     [&](const Cell& cell) { return lit(cell) && cell.size == size; }));
      fmt::print(" {} |\n", meanText(column, resolution, lit));
    }
  }

  /// The cell at each light, or nothing where none is known.
  std::string cellText(const std::string& column, Cell cell) const {
    std::vector<std::string> texts;
    bool any = false;
    for (const std::string& light : choice_.lights) {
      cell.light = light;
      const Scores* scores = find(column, cell);
      any = any || scores;
      texts.push_back(scores ? fmt::format("{:.1f} ± {:.1f} ({:+.1f})", 100 * scores->back().rmse,
                                           100 * scores->back().error, 100 * scores->back().bias)
                             : "-");
    }
    return any ? fmt::format("{}", fmt::join(texts, " / ")) : "";
  }

  void printCells(const std::string& column) const {
    fmt::print("\n**{}**, {}\n\n", column, plan_.resolutions.back());
    printHead("| shape | material |", "");
    for (const double g : choice_.gs)
      for (const std::string& shape : choice_.shapes)
        for (const std::string& material : choice_.materials) {
          std::string row;
          bool any = false;
          for (const double size : choice_.sizes) {
            const std::string text = cellText(column, {shape, material, size, "", g});
            any = any || !text.empty();
            row += fmt::format(" {} |", text.empty() ? "-" : text);
          }
          if (any)
            fmt::print("| {} | {}{} |{}\n", shape, material, g != 0 ? fmt::format(", g = {}", g) : "", row);
        }
  }

  void printMisses(const std::string& column) const {
    const bool first = column.starts_with("first");
    const double asked = first ? kAskedFirst : kAsked;
    fmt::print("\n**{}** above {:.0f} %{}, {}:\n\n", column, 100 * asked,
               first ? fmt::format(" from {} mm up", kAskedFirstFrom) : "", plan_.resolutions.back());
    size_t found = 0, all = 0;
    for (const auto& [key, scores] : results_) {
      if (key.first != column || (first && key.second.size < kAskedFirstFrom)) continue;
      ++all;
      const Score& s = scores.back();
      if (s.rmse <= asked) continue;
      ++found;
      fmt::print("- {}: {:.1f} ± {:.1f} % (without its noise {:.1f}, mean {:+.1f})\n", key.second.name(),
                 100 * s.rmse, 100 * s.error, 100 * s.quiet, 100 * s.bias);
    }
    fmt::print("\n{} of {} cells.\n", found, all);
  }

  const Choice& choice_;
  const TablePlan& plan_;
  const Results& results_;
};

}  // namespace

void printTables(const Choice& choice, const TablePlan& plan, const Results& results) {
  Tables(choice, plan, results).print();
}

}  // namespace lychnite::accuracy
