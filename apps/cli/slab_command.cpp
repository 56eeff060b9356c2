#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands.h"
#include "lychnite/app/specs.h"
#include "lychnite/base/atomic_file.h"
#include "lychnite/base/error.h"
#include "lychnite/base/units.h"
#include "lychnite/optics/materials.h"
#include "lychnite/reference/slab.h"
#include "terminal.h"

namespace lychnite::cli {
namespace {

struct Flags {
  std::string material, sigma_s, sigma_a, g, eta, thickness = "inf", incidence = "0", radial, radialStep,
                                                  photons = "1000000";
  int radialBins = 200, threads = 0;
  uint64_t seed = 1;
  bool json = false;
};

struct Share {
  const char* name;
  const char* words;
  const SlabShare& share;
};

std::vector<Share> sharesOf(const SlabResult& r) {
  return {{"diffuse_reflectance", "diffuse reflectance", r.diffuse_reflectance},
          {"specular_reflectance", "specular reflectance", r.specular_reflectance},
          {"total_transmittance", "total transmittance", r.total_transmittance},
          {"unscattered_transmittance", "  of it unscattered", r.unscattered_transmittance},
          {"absorbed", "absorbed", r.absorbed}};
}

/// A scalar when the user gave scalars, three numbers otherwise.
nlohmann::ordered_json value(const Rgb& v, bool scalar) {
  if (scalar) return v.x;
  return {v.x, v.y, v.z};
}

void print(const SlabResult& result, bool scalar, bool json) {
  if (json) {
    nlohmann::ordered_json out;
    for (const Share& s : sharesOf(result)) {
      out[s.name] = value(s.share.value, scalar);
      out[std::string(s.name) + "_se"] = value(s.share.standardError, scalar);
    }
    fmt::print("{}\n", out.dump(2));
    return;
  }
  for (const Share& s : sharesOf(result)) {
    fmt::print("{:22}", s.words);
    for (int c = 0; c < (scalar ? 1 : 3); ++c)
      fmt::print("  {:.5f} +- {:.5f}", s.share.value[c], s.share.standardError[c]);
    fmt::print("\n");
  }
}

std::string radialTable(const SlabResult& result, const SlabSettings& settings) {
  std::string text =
      "# exitance around a pencil beam per unit power, 1/mm^2: r_mm, then R,G,B reflected, their standard "
      "errors, "
      "R,G,B transmitted, their standard errors\n";
  for (size_t i = 0; i < result.radialReflectance.size(); ++i) {
    const SlabShare &up = result.radialReflectance[i], &down = result.radialTransmittance[i];
    text += fmt::format("{:.6g}", 0.5 * (settings.ringEdges[i] + settings.ringEdges[i + 1]));
    for (const Rgb& v : {up.value, up.standardError, down.value, down.standardError})
      text += fmt::format(" {:.6g} {:.6g} {:.6g}", v.x, v.y, v.z);
    text += "\n";
  }
  return text;
}

/// mm; where not given, a twentieth of the reduced mean free path, which resolves the profile's core.
double ringWidth(const Flags& flags, const Coefficients& medium) {
  if (!flags.radialStep.empty()) return parseLength(flags.radialStep, "--radial-step");
  const Rgb sigma_tp = medium.sigma_tp();
  const double largest = std::max({sigma_tp.x, sigma_tp.y, sigma_tp.z});
  return largest > 0 ? 0.05 / largest : 1;
}

SlabSettings settingsFrom(const Flags& flags) {
  SlabSettings settings;
  if (!flags.material.empty())
    settings.medium = findMaterial(flags.material, "--material").coefficients;
  else if (flags.sigma_s.empty() || flags.sigma_a.empty())
    throw Error({.where = "slab",
                 .expected = "--sigma-s and --sigma-a in 1/mm, or --material",
                 .found = "neither",
                 .todo = ""},
                Error::Kind::kUsage);
  if (!flags.sigma_s.empty()) settings.medium.sigma_s = parseRgb(flags.sigma_s, "--sigma-s");
  if (!flags.sigma_a.empty()) settings.medium.sigma_a = parseRgb(flags.sigma_a, "--sigma-a");
  if (!flags.g.empty()) settings.medium.g = parseNumber(flags.g, "--g");
  if (!flags.eta.empty()) settings.medium.eta = parseNumber(flags.eta, "--eta");
  if (flags.thickness != "inf") settings.thickness = parseLength(flags.thickness, "--thickness");
  settings.diffuse = flags.incidence == "diffuse";
  if (!settings.diffuse) settings.incidenceDegrees = parseNumber(flags.incidence, "--incidence");
  const double photons = parseNumber(flags.photons, "--photons");
  if (!(photons >= 1 && photons <= 1e13))
    throw Error({.where = "--photons", .expected = "1 to 1e13", .found = flags.photons, .todo = ""},
                Error::Kind::kUsage);
  settings.photons = uint64_t(photons);
  settings.seed = flags.seed;
  settings.threads = flags.threads;
  if (flags.radial.empty()) return settings;
  const double step = ringWidth(flags, settings.medium);
  for (int i = 0; i <= flags.radialBins; ++i) settings.ringEdges.push_back(i * step);
  return settings;
}

bool scalarFlags(const Flags& flags) {
  return flags.material.empty() && flags.sigma_s.find(',') == std::string::npos &&
         flags.sigma_a.find(',') == std::string::npos;
}

int slab(const Flags& flags) {
  const SlabSettings settings = settingsFrom(flags);
  const SlabResult result = simulateSlab(settings, terminalProgress());
  finishProgress();
  if (!flags.radial.empty()) writeTextAtomically(flags.radial, radialTable(result, settings));
  print(result, scalarFlags(flags), flags.json);
  return 0;
}

}  // namespace

void addSlab(CLI::App& app, Action& action) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command =
      app.add_subcommand("slab", "Reflectance and transmittance of a plane slab by Monte Carlo transport");
  command->add_option("--material", flags->material, "a name from `lychnite materials`");
  command->add_option("--sigma-a", flags->sigma_a, "absorption coefficient in 1/mm, one number or R,G,B");
  command->add_option("--sigma-s", flags->sigma_s, "scattering coefficient in 1/mm, one number or R,G,B");
  command->add_option("--g", flags->g, "mean cosine of scattering, -1 to 1 (0)");
  command->add_option("--eta", flags->eta, "refractive index, inside over outside (1.3)");
  command->add_option("--thickness", flags->thickness, "with a unit, or inf for a half-space (inf)");
  command->add_option("--incidence", flags->incidence, "degrees from the normal, or diffuse (0)");
  command->add_option("--photons", flags->photons, "how many (1000000)");
  command->add_option("--radial", flags->radial, "write the exitance around a pencil beam as a table");
  command->add_option("--radial-bins", flags->radialBins, "rings of that table (200)")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--radial-step", flags->radialStep, "width of a ring, with a unit");
  command->add_option("--seed", flags->seed, "of the random numbers (1)")->check(CLI::NonNegativeNumber);
  command->add_option("--threads", flags->threads, "0 = all cores")->check(CLI::Range(0, 1024));
  command->add_flag("--json", flags->json, "machine-readable");
  command->callback([flags, &action] { action = [flags] { return slab(*flags); }; });
}

}  // namespace lychnite::cli
