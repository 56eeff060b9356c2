// lychnite: translucent things as they look at their true size. One subcommand a file; exit status 0 done, 1
// bad input, 2 wrong usage, 3 no usable OpenGL, 130 interrupted.
#include <fmt/format.h>

#include <new>

#include "commands.h"
#include "lychnite/app/image_maker.h"
#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "terminal.h"

namespace lychnite::cli {
namespace {

int statusOf(Error::Kind kind) {
  switch (kind) {
    case Error::Kind::kUsage:
      return 2;
    case Error::Kind::kDevice:
      return 3;
    default:
      return 1;
  }
}

/// The flag or command nearest to what was not understood.
std::string suggestion(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> known;
  for (const CLI::App* sub : app.get_subcommands({})) known.push_back(sub->get_name());
  const CLI::App* chosen = &app;
  for (int i = 1; i < argc; ++i) {
    const std::string word = split(argv[i], '=').front();
    if (chosen == &app) {
      for (const CLI::App* sub : app.get_subcommands({}))
        if (sub->get_name() == word) chosen = sub;
      if (chosen != &app) continue;
    }
    if (word.rfind("--", 0) != 0) {
      if (chosen == &app && i == 1) return nearestName(word, known);
      continue;
    }
    known.clear();
    bool understood = false;
    for (const CLI::Option* option : chosen->get_options()) {
      for (const std::string& name : option->get_lnames()) {
        known.push_back("--" + name);
        understood = understood || word == "--" + name;
      }
    }
    if (!understood) return nearestName(word, known);
  }
  return "";
}

int usageError(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  std::string message = error.what();
  for (char& c : message)
    if (c == '\n') c = ' ';
  if (argc > 1 && argv[1][0] != '-' && app.get_subcommands().empty())
    message = fmt::format("there is no command '{}'", argv[1]);
  const std::string nearest = suggestion(app, argc, argv);
  const bool unknown =
      dynamic_cast<const CLI::ExtrasError*>(&error) || dynamic_cast<const CLI::RequiredError*>(&error);
  fmt::print(stderr, "lychnite: {}{}\n", message,
             !nearest.empty() && unknown ? fmt::format("; did you mean '{}'?", nearest)
                                         : "; `lychnite --help` lists everything");
  return 2;
}

int run(int argc, char** argv) {
  CLI::App app(
      "Renders translucent things as they look at their true size, and says how far each picture is from "
      "true "
      "light transport.",
      "lychnite");
  app.set_version_flag("--version", std::string("lychnite ") + versionText());
  app.require_subcommand(1);
  Action action;
  addRender(app, action);
  addView(app, action);
  addCompare(app, action);
  addSlab(app, action);
  addBench(app, action);
  addPaper(app, action);
  addInfo(app, action);
  addMaterials(app, action);
  addModels(app, action);
  addDevices(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return usageError(app, error, argc, argv);
  }
  return action();
}

}  // namespace
}  // namespace lychnite::cli

int main(int argc, char** argv) {
  using namespace lychnite;
  try {
    return cli::run(argc, argv);
  } catch (const Error& error) {
    cli::finishProgress();
    fmt::print(stderr, "lychnite: {}\n", error.what());
    return cli::statusOf(error.kind());
  } catch (const Interrupted&) {
    cli::finishProgress();
    fmt::print(stderr, "lychnite: interrupted; what was not finished was not kept\n");
    return 130;
  } catch (const std::bad_alloc&) {
    cli::finishProgress();
    fmt::print(stderr, "lychnite: not enough memory for this; use a smaller mesh, map or resolution\n");
    return 1;
  } catch (const std::exception& error) {
    cli::finishProgress();
    fmt::print(stderr, "lychnite: {}\n", error.what());
    return 1;
  }
}
