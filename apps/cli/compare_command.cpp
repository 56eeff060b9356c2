#include <fmt/format.h>

#include "commands.h"
#include "lychnite/app/report.h"
#include "lychnite/base/error.h"
#include "lychnite/base/units.h"
#include "lychnite/image/io.h"
#include "lychnite/image/metrics.h"

namespace lychnite::cli {
namespace {

struct Flags {
  std::string a, b, heatmap, exposure = "0";
  bool json = false, standardError = false;
};

void printMetrics(const char* name, const Metrics& m) {
  fmt::print("{:9} {:>9.3f} % {:>+9.3f} % {:>9.4f} {:>9.3f} % {:>8.2f} dB {:>8.4f}\n", name,
             m.relative_rmse * 100, m.bias * 100, m.best_gain, m.relative_rmse_after_gain * 100, m.psnr,
             m.ssim);
}

int compareFiles(const Flags& flags) {
  const double exposure = parseNumber(flags.exposure, "--exposure");
  if (!flags.heatmap.empty() && !flags.heatmap.ends_with(".png"))
    throw Error({.where = "--heatmap",
                 .expected = "a file ending in .png",
                 .found = fmt::format("'{}'", flags.heatmap),
                 .todo = ""},
                Error::Kind::kUsage);
  const Image a = readImage(flags.a), b = readImage(flags.b);
  const Comparison result = compare(a, b, {.exposure = exposure, .useStandardError = flags.standardError});
  if (!flags.heatmap.empty()) writePng(errorMap(a, b), flags.heatmap);
  if (flags.json) {
    fmt::print("{}", comparisonJson(result));
    return 0;
  }
  fmt::print("{:9} {:>11} {:>11} {:>9} {:>11} {:>11} {:>8}\n", "", "rel. RMSE", "bias", "best gain",
             "after gain", "PSNR", "SSIM");
  printMetrics("together", result.together);
  const char* names[] = {"red", "green", "blue"};
  for (size_t c = 0; c < 3; ++c) printMetrics(names[c], result.channels[c]);
  fmt::print("FLIP {:.4f}, {} pixels of B covered\n", result.flip, result.pixels);
  return 0;
}

}  // namespace

void addCompare(CLI::App& app, Action& action) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = app.add_subcommand("compare", "How far picture A is from picture B, in numbers");
  command->add_option("A", flags->a, "EXR or PNG")->required();
  command->add_option("B", flags->b, "the reference, EXR or PNG")->required();
  command->add_flag("--json", flags->json, "machine-readable");
  command->add_option("--heatmap", flags->heatmap, "write the error per pixel in false colour (PNG)");
  command->add_flag("--se", flags->standardError, "take B's standard error (AOV stderr) out of the error");
  command->add_option("--exposure", flags->exposure, "stops, for PSNR, SSIM and FLIP");
  command->callback([flags, &action] { action = [flags] { return compareFiles(*flags); }; });
}

}  // namespace lychnite::cli
