#include "commands.h"
#include "lychnite/app/specs.h"
#include "lychnite/base/error.h"
#include "lychnite/base/units.h"
#include "lychnite/scene/settings.h"
#include "terminal.h"
#include "viewer/viewer.h"

namespace lychnite::cli {
namespace {

struct Flags {
  std::string model = "figurine", size, method, screenshot, play, window;
  double scale = 0;
  int threads = 0;
  bool debug = false, verbose = false;
};

int view(const Flags& flags) {
  viewer::ViewOptions options{.model = flags.model,
                              .screenshot = flags.screenshot,
                              .play = flags.play,
                              .threads = flags.threads,
                              .debug = flags.debug,
                              .log = terminalLog(flags.verbose)};
  if (!flags.size.empty()) options.size = parseLength(flags.size, "--size");
  if (options.size && !(*options.size > 0))
    throw Error({.where = "--size", .expected = "a length above zero", .found = flags.size, .todo = ""},
                Error::Kind::kUsage);
  if (!flags.method.empty()) {
    options.method = parseMethod(flags.method, "--method");
    if (isReference(*options.method))
      throw Error({.where = "--method",
                   .expected = "volume, matched, adaptive or fixed",
                   .found = "'" + flags.method + "'",
                   .todo = "the walk and the dipole are found under Compare in the window"},
                  Error::Kind::kUsage);
  }
  if (!flags.window.empty()) {
    const Resolution resolution = parseResolution(flags.window, "--window");
    options.width = resolution.width;
    options.height = resolution.height;
  }
  if (flags.scale > 0) options.scale = flags.scale;
  if (!flags.screenshot.empty() && !flags.screenshot.ends_with(".png"))
    throw Error(
        {.where = "--screenshot", .expected = "a file ending in .png", .found = flags.screenshot, .todo = ""},
        Error::Kind::kUsage);
  viewer::runViewer(options);
  return 0;
}

}  // namespace

void addView(CLI::App& app, Action& action) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = app.add_subcommand("view", "Open a window on a model or scene");
  command->add_option("MODEL", flags->model, "mesh file, built-in model or scene.toml (default figurine)");
  command->add_option("--size", flags->size, "true size: longest side of the bounding box, with a unit");
  command->add_option("--method", flags->method, "volume (default), matched, adaptive or fixed");
  command->add_option("--window", flags->window, "WxH of the window at scale 1 (as it was last time)");
  command->add_option("--scale", flags->scale, "of everything in the window (the display's)")
      ->check(CLI::Range(0.5, 4.0));
  command->add_option("--threads", flags->threads, "CPU threads of the walk in the background")
      ->check(CLI::Range(0, 1024));
  command->add_option("--screenshot", flags->screenshot,
                      "write the window here once the picture is whole, and quit");
  command->add_option("--play", flags->play, "play this list of input events, and quit");
  command->add_flag("--debug", flags->debug, "OpenGL debug context; its errors are failures");
  command->add_flag("--verbose", flags->verbose, "repeat the window's messages on stderr");
  command->callback([flags, &action] { action = [flags] { return view(*flags); }; });
}

}  // namespace lychnite::cli
