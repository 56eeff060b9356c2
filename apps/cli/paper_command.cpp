#include <fmt/format.h>

#include "commands.h"
#include "lychnite/app/paper.h"
#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "terminal.h"

namespace lychnite::cli {
namespace {

struct Flags {
  std::string output, models, only, device = "auto";
  bool quick = false, list = false;
};

int paper(const Flags& flags) {
  if (flags.list) {
    for (const PaperPartName& part : paperParts()) fmt::print("{:10} {}\n", part.name, part.title);
    return 0;
  }
  PaperSettings settings{.output = flags.output,
                         .models = flags.models,
                         .quick = flags.quick,
                         .device = flags.device,
                         .log = terminalLog(false)};
  if (settings.output.empty())
    throw Error({.where = "-o", .expected = "a folder to write to", .found = "none", .todo = ""},
                Error::Kind::kUsage);
  if (!flags.only.empty()) settings.only = split(flags.only, ',');
  try {
    const PaperResult result = makePaper(settings, terminalProgress());
    finishProgress();
    fmt::print("{}: {} parts made, {} kept\n", result.page.string(), result.made.size(), result.kept.size());
    return 0;
  } catch (const Interrupted&) {
    finishProgress();
    fmt::print(stderr, "lychnite: interrupted; {} keeps what is finished, and the same command goes on\n",
               flags.output);
    return 130;
  }
}

}  // namespace

void addPaper(CLI::App& app, Action& action) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command =
      app.add_subcommand("paper", "Reproduce every figure and table of Yao & Wang 2009, with errors");
  command->add_option("-o,--output", flags->output, "folder of the report; goes on with what is there");
  command->add_option("--models", flags->models, "folder of bunny.ply and dragon.ply")
      ->check(CLI::ExistingDirectory);
  command->add_flag("--quick", flags->quick,
                    "small pictures, few photons: a look in minutes, not a measurement");
  command->add_option("--only", flags->only, "parts, by the names that --list gives");
  command->add_flag("--list", flags->list, "print the parts' names and titles");
  command->add_option("--device", flags->device, "auto, gpu, cpu or a number from `lychnite devices`");
  command->callback([flags, &action] { action = [flags] { return paper(*flags); }; });
}

}  // namespace lychnite::cli
