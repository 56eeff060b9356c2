#include <fmt/format.h>

#include "commands.h"
#include "lychnite/app/report.h"
#include "lychnite/base/error.h"
#include "lychnite/gpu/context.h"
#include "lychnite/mesh/builtin.h"
#include "lychnite/mesh/load.h"
#include "lychnite/optics/profile.h"
#include "lychnite/scene/scene_file.h"
#include "terminal.h"

namespace lychnite::cli {
namespace {

std::string yesNo(bool value) {
  return value ? "yes" : "no";
}

void printInfo(const std::string& model, const MeshInfo& info, const LoadedMesh* loaded) {
  const auto line = [](const char* name, const std::string& value) { fmt::print("{:20} {}\n", name, value); };
  line("model", model);
  line("triangles", std::to_string(info.triangles));
  line("vertices", std::to_string(info.vertices));
  line("closed", yesNo(info.closed));
  line("boundary edges", std::to_string(info.boundary_edges));
  line("non-manifold edges", std::to_string(info.non_manifold_edges));
  line("components", std::to_string(info.components));
  const glm::dvec3 low = info.bounds.min, high = info.bounds.max;
  line("bounds", fmt::format("{:.6g} {:.6g} {:.6g} to {:.6g} {:.6g} {:.6g} (file units)", low.x, low.y, low.z,
                             high.x, high.y, high.z));
  line("memory", fmt::format("{:.2f} MB", double(info.memory_bytes) / 1e6));
  if (!loaded) return;
  const RepairReport& r = loaded->report;
  line("in the file", fmt::format("{} triangles, {} vertices", r.file_triangles, r.file_vertices));
  line("duplicate vertices", fmt::format("{} (welded)", r.duplicate_vertices));
  line("degenerate triangles", fmt::format("{} (dropped)", r.degenerate_triangles));
  line("unused vertices", fmt::format("{} (dropped)", r.unused_vertices));
  line("normals", r.normals_made ? "made, angle-weighted" : "from the file");
  if (r.flipped) line("orientation", "was inside out, turned");
  if (loaded->animation)
    for (const MeshAnimation::Clip& clip : loaded->animation->clips())
      line("animation", fmt::format("{}, {:.3g} s", clip.name, clip.seconds));
  line("load time", fmt::format("{:.3f} s", loaded->seconds));
}

int info(const std::string& model, bool json, bool verbose) {
  const LogSink log = terminalLog(verbose);
  const bool builtin = builtinMesh(model) != nullptr;
  LoadedMesh loaded;
  if (builtin)
    loaded.mesh = builtinMesh(model);
  else if (model.find('.') == std::string::npos && model.find('/') == std::string::npos)
    loaded.mesh = loadObject(model).mesh;
  else
    loaded = loadMesh(model, log);
  const MeshInfo facts = inspect(*loaded.mesh);
  const LoadedMesh* file = builtin ? nullptr : &loaded;
  if (json)
    fmt::print("{}", infoJson(model, facts, file));
  else
    printInfo(model, facts, file);
  return 0;
}

std::string triple(const Rgb& v, const char* format) {
  std::string text;
  for (int c = 0; c < 3; ++c) text += fmt::format(fmt::runtime(format), v[c]);
  return text;
}

int materials(bool json) {
  if (json) {
    fmt::print("{}", materialsJson());
    return 0;
  }
  fmt::print("{:11}{:^24}{:^24}{:^24}{:^21}{:>5}\n", "", "mean free path (mm)", "albedo",
             "transport length (mm)", "diffuse reflectance", "eta");
  for (const NamedCoefficients& material : materialLibrary()) {
    const Coefficients& m = material.coefficients;
    fmt::print("{:11}{}{}{}{}{:>5}\n", material.name, triple(m.mean_free_path(), "{:>8.3f}"),
               triple(m.albedo(), "{:>8.4f}"), triple(1.0 / m.sigma_tr(), "{:>8.2f}"),
               triple(makeDipole(m)->P(0), "{:>7.3f}"), m.eta);
  }
  return 0;
}

int models() {
  for (const BuiltinModel& model : builtinModels())
    fmt::print("{:10} {:>7} triangles {:>7} vertices  {}\n", model.name, model.triangles, model.vertices,
               model.description);
  return 0;
}

int devices() {
  const auto list = gpu::listDevices();
  if (list.empty())
    throw Error({.where = "devices",
                 .expected = "",
                 .found = "no OpenGL device through EGL",
                 .todo = "install Mesa's libegl1 and libgl1-mesa-dri, or a GPU driver"},
                Error::Kind::kDevice);
  bool usable = false;
  for (const gpu::DeviceInfo& device : list) {
    usable = usable || device.usable;
    fmt::print("{} {:12} {}\n", device.index, device.platform,
               device.usable ? fmt::format("{} ({}, OpenGL {}{})", device.renderer, device.vendor,
                                           device.version, device.software ? ", software" : "")
                             : "not usable: " + device.problem);
  }
  return usable ? 0 : 3;
}

}  // namespace

void addInfo(CLI::App& app, Action& action) {
  auto model = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false), verbose = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("info", "What a mesh file or built-in model holds, and what loading repairs");
  command->add_option("MODEL", *model, "mesh file or built-in model")->required();
  command->add_flag("--json", *json, "machine-readable");
  command->add_flag("--verbose", *verbose, "say more while loading");
  command->callback([=, &action] { action = [=] { return info(*model, *json, *verbose); }; });
}

void addMaterials(CLI::App& app, Action& action) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("materials", "The material library");
  command->add_flag("--json", *json, "machine-readable");
  command->callback([json, &action] { action = [json] { return materials(*json); }; });
}

void addModels(CLI::App& app, Action& action) {
  app.add_subcommand("models", "The built-in models")->callback([&action] { action = models; });
}

void addDevices(CLI::App& app, Action& action) {
  app.add_subcommand("devices", "The OpenGL devices of this machine")->callback([&action] {
    action = devices;
  });
}

}  // namespace lychnite::cli
