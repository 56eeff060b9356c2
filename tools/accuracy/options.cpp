#include "options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "lychnite/base/error.h"

namespace lychnite::accuracy {

namespace {

constexpr const char* kAbout =
    "Measures how far methods are from the walk, the truth, over shapes, materials, sizes and lights, and "
    "prints tables (markdown). What is made is kept in folders and found again, so that it can be stopped "
    "and "
    "gone on with. Shapes are the built-in ones and NAME.ply of --models.";

template <class List>
void addList(CLI::App& app, const char* flag, List& list, const std::string& what) {
  app.add_option(flag, list, fmt::format("{}, by commas ({})", what, fmt::join(list, ",")))
      ->delimiter(',')
      ->allow_extra_args(false);
}

[[noreturn]] void refuse(const char* where, const char* expected, const std::string& found) {
  throw Error({.where = where, .expected = expected, .found = found, .todo = {}}, Error::Kind::kUsage);
}

void check(const Options& options) {
  for (const double size : options.choice.sizes)
    if (!(size > 0 && size <= 1e6)) refuse("--sizes", "mm, more than 0, up to 1e6", fmt::format("{}", size));
  for (const double g : options.choice.gs)
    if (!(g > -1 && g < 1)) refuse("--g", "numbers between -1 and 1", fmt::format("{}", g));
  if (!(options.seconds >= 0)) refuse("--seconds", "0 or more", fmt::format("{}", options.seconds));
  if (!(options.noise >= 0)) refuse("--noise", "0 or more", fmt::format("{}", options.noise));
  if (options.threads < 0) refuse("--threads", "0 or more", fmt::format("{}", options.threads));
}

}  // namespace

std::optional<Options> parseOptions(int argc, char** argv) {
  Options options;
  options.choice = everything();
  options.columns = {"volume"};
  std::string unit = "surface";
  bool onlyReferences = false, onlyMade = false, onlyKept = false;
  CLI::App app(kAbout, "accuracy");
  app.add_option("--references", options.references, "folder of the walk's results")->required();
  app.add_option("--models", options.models, "folder of NAME.ply");
  app.add_option("--scores", options.scores,
                 "folder of what columns scored; another one for each state of a method (as "
                 "--references)");
  app.add_option("--unit", unit, "surface: equal patches of the whole surface; picture: a camera's pixels")
      ->check(CLI::IsMember({"surface", "picture"}))
      ->capture_default_str();
  addList(
      app, "--columns", options.columns,
      "volume[:CELLS[:PASSES]], first[:CELLS] (volume's first picture), a profile (dipole, better-dipole, "
      "normalized-diffusion, tabulated, tabulated-two-up) or a method");
  addList(app, "--shapes", options.choice.shapes, "shapes");
  addList(app, "--materials", options.choice.materials, "materials");
  addList(app, "--sizes", options.choice.sizes, "longest sides in mm");
  addList(app, "--lights", options.choice.lights, "lights");
  addList(app, "--g", options.choice.gs,
          "mean cosines at equal sigma_sp; other than 0 for sphere, figurine, bunny_filled in fig6 and skin1 "
          "only");
  app.add_option("--seconds", options.seconds, "most time of a reference, both halves (20)");
  app.add_option("--noise", options.noise,
                 "of a reference's half that is enough, standard error over mean (surface .1, picture .06)");
  app.add_flag(
      "--renew", options.renew,
      "surface: make references again that are noisier than 1.5 of that and had less than --seconds");
  app.add_option("--threads", options.threads, "0 for all cores")->capture_default_str();
  auto* references =
      app.add_flag("--only-references", onlyReferences, "make the missing references, nothing else");
  auto* made = app.add_flag("--only-made", onlyMade, "leave out cells whose references are not there")
                   ->excludes(references);
  app.add_flag("--only-kept", onlyKept, "print what is kept and make nothing")
      ->excludes(references)
      ->excludes(made);
  app.add_option("--pictures", options.pictures, "also write some cells side by side to this folder");
  app.add_option("--sheets", options.sheets,
                 "only write a picture for each shape to this folder: the walk and the columns, fig6 from "
                 "behind, 3, 30 and 300 mm");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    app.exit(success);
    return {};
  } catch (const CLI::ParseError& error) {
    std::string message = error.what();
    std::ranges::replace(message, '\n', ' ');
    throw Error({.where = {}, .expected = {}, .found = {}, .todo = message + "; --help lists everything"},
                Error::Kind::kUsage);
  }
  options.unit = unit == "picture" ? Unit::kPicture : Unit::kSurface;
  options.make = onlyReferences ? Make::kReferences
                 : onlyMade     ? Make::kScores
                 : onlyKept     ? Make::kNothing
                                : Make::kAll;
  if (options.scores.empty()) options.scores = options.references;
  check(options);
  if (options.seconds == 0) options.seconds = 20;
  if (options.noise == 0) options.noise = options.unit == Unit::kSurface ? 0.1 : 0.06;
  return options;
}

}  // namespace lychnite::accuracy
