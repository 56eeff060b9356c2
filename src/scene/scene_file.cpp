#include "lychnite/scene/scene_file.h"

#include <fmt/format.h>

#include <glm/gtc/quaternion.hpp>
#include <system_error>

#include "lychnite/base/atomic_file.h"
#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/base/text_file.h"
#include "lychnite/mesh/builtin.h"
#include "lychnite/mesh/load.h"
#include "scene/scene_toml.h"

namespace lychnite {
namespace fs = std::filesystem;

namespace {

bool looksLikeAFile(const std::string& model) {
  return model.find('/') != std::string::npos || model.find('.') != std::string::npos;
}

[[noreturn]] void refuseUnknownModel(const std::string& model) {
  std::vector<std::string> names;
  for (const BuiltinModel& known : builtinModels()) names.push_back(known.name);
  const std::string nearest = nearestName(model, names);
  throw Error({.where = model,
               .expected = "a mesh file or a built-in model",
               .found = "neither",
               .todo = nearest.empty() ? "`lychnite models` lists the built-in ones"
                                       : fmt::format("did you mean '{}'?", nearest)});
}

void reportRepairs(const LoadedMesh& loaded, const std::string& model, const LogSink& log) {
  const RepairReport& r = loaded.report;
  if (r.boundary_edges > 0)
    logTo(
        log, LogLevel::kWarning,
        fmt::format("{}: the surface has holes ({} open edges), so that light inside it is not well defined",
                    model, r.boundary_edges));
  if (r.duplicate_vertices || r.degenerate_triangles || r.unused_vertices || r.flipped)
    logTo(log, LogLevel::kInfo,
          fmt::format(
              "{}: welded {} duplicate vertices, dropped {} degenerate triangles and {} unused vertices{}",
              model, r.duplicate_vertices, r.degenerate_triangles, r.unused_vertices,
              r.flipped ? ", turned the inside out" : ""));
}

}  // namespace

Object loadObject(const std::string& model, const fs::path& folder, const LogSink& log) {
  Object object;
  object.model = model;
  std::error_code code;
  const fs::path path = fs::path(model).is_absolute() ? fs::path(model) : folder / model;
  // A built-in's name means the built-in, unless it is written like a path: ./sphere is a file.
  if (!looksLikeAFile(model)) object.mesh = builtinMesh(model);
  if (object.mesh) return object;
  if (!fs::exists(path, code) && !looksLikeAFile(model)) refuseUnknownModel(model);
  const LoadedMesh loaded = loadMesh(path, log);
  reportRepairs(loaded, model, log);
  object.mesh = loaded.mesh;
  object.animation = loaded.animation;
  return object;
}

Scene readScene(const fs::path& path, const LogSink& log) {
  std::error_code code;
  if (fs::is_directory(path, code))
    throw Error({.where = path.string(), .expected = "a scene file", .found = "a folder", .todo = ""});
  const std::string text = readText(path);
  try {
    return sceneFromToml(text, path, log);
  } catch (const Error& error) {
    // What is wrong usage on a command line is bad input in a file.
    throw Error(error.parts(), Error::Kind::kInput);
  }
}

void writeScene(const Scene& scene, const fs::path& path) {
  writeTextAtomically(path, sceneToToml(scene));
}

}  // namespace lychnite
