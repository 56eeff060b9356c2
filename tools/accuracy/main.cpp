// accuracy: how far methods are from the walk, into the tables of docs/accuracy.md. Exit status 0 done, 1 bad
// input, 2 wrong usage, 130 interrupted; what was finished is kept.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <fstream>
#include <thread>

#include "lychnite/base/atomic_file.h"
#include "lychnite/base/error.h"
#include "models.h"
#include "options.h"
#include "references.h"
#include "sheets.h"
#include "tables.h"
#include "terminal.h"

namespace lychnite::accuracy {

namespace {

constexpr int kPixels = 80, kSheetPixels = 120, kWidePixels = 160;  // of pictures, each way
constexpr double kMostUncertainSurface = 0.03, kMostUncertainPicture = 0.1;

class Study {
 public:
  explicit Study(const Options& options)
      : options_(options),
        shapes_(options.models),
        references_(options.references, {.seconds = options.seconds, .noise = options.noise}, shapes_),
        models_(shapes_) {
    for (const std::string& name : options.columns) columns_.push_back(columnOf(name));
    for (const Column& column : columns_)
      if (onSurface()) requireOnSurface(column);
    for (const std::string& shape : options.choice.shapes) shapes_.at(shape);
  }

  /// Makes what is missing, as far as that is wished. What is there is not in the time that is left.
  void make(const std::vector<Cell>& cells) {
    std::vector<Cell> missing;
    for (const Cell& cell : cells)
      if (!isDone(cell)) missing.push_back(cell);
    for (size_t i = 0; i < missing.size(); ++i) {
      const Progress inner([&, i](const Progress::Update& update) {
        const double fraction = (double(i) + update.fraction) / double(missing.size());
        return terminal_.update({missing[i].name(), fraction, fmt::format("{}/{}", i + 1, missing.size())});
      });
      inner.check({"", 0, ""});
      if (lacksReference(missing[i])) provide(missing[i], inner);
      if (options_.make == Make::kReferences) continue;
      for (const Column& column : columns_) score(missing[i], column, inner);
    }
    cli::finishProgress();
  }

  void print() const {
    TablePlan plan{options_.columns, {fmt::format("{0} x {0} pixels", kPixels)}, kMostUncertainPicture};
    if (onSurface()) {
      plan.resolutions = {fmt::format("{} patches", kPatches), fmt::format("{} patches", kCoarsePatches)};
      plan.mostUncertain = kMostUncertainSurface;
    }
    printTables(options_.choice, plan, results_);
  }

  /// One picture for each shape: the walk and the columns.
  void writeSheets() {
    std::filesystem::create_directories(options_.sheets);
    for (const std::string& shape : options_.choice.shapes) {
      std::vector<Cell> cells;
      for (const double size : {3.0, 30.0, 300.0}) cells.push_back({shape, "fig6", size, "behind", 0});
      writeSheet({references_, models_}, cells, columns_, kSheetPixels, options_.sheets / (shape + ".png"),
                 terminal_);
    }
  }

  /// The cells that docs/accuracy.md shows.
  void writePictures() {
    std::filesystem::create_directories(options_.pictures);
    for (const Cell& cell :
         {Cell{"figurine", "fig6", 3, "behind", 0}, Cell{"figurine", "skin1", 10, "behind", 0},
          Cell{"bunny_filled", "fig6", 10, "behind", 0}, Cell{"bunny_filled", "marble", 30, "behind", 0}})
      writeSheet({references_, models_}, {cell}, columns_, kWidePixels,
                 options_.pictures / (cell.name() + ".png"), terminal_);
  }

 private:
  bool onSurface() const { return options_.unit == Unit::kSurface; }
  int pixels() const { return onSurface() ? 0 : kPixels; }

  /// Whether it is missing, or is to be made again.
  bool lacksReference(const Cell& cell) const {
    return !references_.madeAt(cell, pixels()) ||
           (options_.renew && onSurface() && references_.isTooNoisy(cell));
  }

  /// Takes the scores that are kept; true where nothing is missing or nothing may be made.
  bool isDone(const Cell& cell) {
    const bool makesReferences = options_.make == Make::kAll || options_.make == Make::kReferences;
    const bool lacking = options_.make != Make::kNothing && lacksReference(cell);
    if (options_.make == Make::kReferences) return !lacking;
    bool all = true;
    for (const Column& column : columns_) {
      const auto scores = keptScores(cell, column);
      if (scores) results_[{column.name, cell}] = *scores;
      all = all && scores;
    }
    if (options_.make == Make::kNothing || (lacking && !makesReferences)) return true;
    return all && !lacking;
  }

  void provide(const Cell& cell, const Progress& progress) {
    if (onSurface())
      references_.makeSurface(cell, progress);
    else
      references_.picture(cell, kPixels, progress);
  }

  void score(const Cell& cell, const Column& column, const Progress& progress) {
    auto scores = keptScores(cell, column);
    if (!scores) {
      scores = onSurface() ? surfaceScores(cell, column, progress) : pictureScores(cell, column, progress);
      keepScores(cell, column, *scores);
    }
    results_[{column.name, cell}] = *scores;
  }

  Scores surfaceScores(const Cell& cell, const Column& column, const Progress& progress) {
    const Halves truth = references_.surface(cell, progress);
    const Halves model = models_.onSurface(cell, column, progress);
    constexpr size_t kEach = kPatches / kCoarsePatches;
    const auto coarse = [](const Halves& h) { return Halves{means(h[0], kEach), means(h[1], kEach)}; };
    return {scoreOf(model, truth), scoreOf(coarse(model), coarse(truth))};
  }

  /// Over the pixels that the object covers whole.
  Scores pictureScores(const Cell& cell, const Column& column, const Progress& progress) {
    const PictureTruth truth = references_.picture(cell, kPixels, progress);
    const std::string layer = column.fromSecond ? "" : "radiosity";
    const auto covered = [&](const Values& values) {
      Values kept;
      const std::vector<float>& alpha = truth.half[0].channel("A");
      for (size_t i = 0; i < values.size(); ++i)
        if (alpha[i] == 1) kept.push_back(values[i]);
      return kept;
    };
    const Values model = covered(models_.inPicture(cell, column, kPixels, progress));
    return {scoreOf({model, model},
                    {covered(valuesOf(truth.half[0], layer)), covered(valuesOf(truth.half[1], layer))})};
  }

  std::filesystem::path scorePath(const Cell& cell, const Column& column) const {
    return options_.scores /
           fmt::format("{}-{}{}.txt", cell.name(), column.name, onSurface() ? "" : "-picture");
  }

  /// None that is older than the truth it was made by.
  std::optional<Scores> keptScores(const Cell& cell, const Column& column) const {
    const auto path = scorePath(cell, column);
    std::ifstream file(path);
    Scores scores(onSurface() ? 2 : 1);
    for (Score& s : scores)
      if (!(file >> s.rmse >> s.error >> s.quiet >> s.bias)) return {};
    const auto truth = references_.madeAt(cell, pixels());
    if (truth && std::filesystem::last_write_time(path) < *truth) return {};
    return scores;
  }

  void keepScores(const Cell& cell, const Column& column, const Scores& scores) const {
    std::string text;
    for (const Score& s : scores) text += fmt::format("{} {} {} {}\n", s.rmse, s.error, s.quiet, s.bias);
    writeTextAtomically(scorePath(cell, column), text);
  }

  const Options& options_;
  Progress terminal_ = cli::terminalProgress();
  Shapes shapes_;
  References references_;
  Models models_;
  std::vector<Column> columns_;
  Results results_;
};

void run(const Options& options) {
  std::filesystem::create_directories(options.references);
  std::filesystem::create_directories(options.scores);
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  options.threads > 0 ? size_t(options.threads) : cores);
  const std::vector<Cell> cells = cellsOf(options.choice);
  Study study(options);
  if (!options.sheets.empty()) return study.writeSheets();
  study.make(cells);
  if (options.make == Make::kReferences) return;
  study.print();
  if (!options.pictures.empty()) study.writePictures();
}

}  // namespace

}  // namespace lychnite::accuracy

int main(int argc, char** argv) {
  using namespace lychnite;
  try {
    if (const auto options = accuracy::parseOptions(argc, argv)) accuracy::run(*options);
    return 0;
  } catch (const Interrupted&) {
    cli::finishProgress();
    fmt::print(stderr, "accuracy: interrupted; what was finished is kept\n");
    return 130;
  } catch (const Error& error) {
    cli::finishProgress();
    fmt::print(stderr, "accuracy: {}\n", error.what());
    return error.kind() == Error::Kind::kUsage ? 2 : 1;
  } catch (const std::exception& error) {
    cli::finishProgress();
    fmt::print(stderr, "accuracy: {}\n", error.what());
    return 1;
  }
}
