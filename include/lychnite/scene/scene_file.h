#pragma once

#include <filesystem>
#include <string>

#include "lychnite/base/log.h"
#include "lychnite/scene/scene.h"

namespace lychnite {

/// Finds a mesh for what the user typed: a built-in's name, else a file (relative to `folder`). Throws Error;
/// a name that is neither suggests the nearest built-in. Mesh warnings (open, repaired) go to `log`.
Object loadObject(const std::string& model, const std::filesystem::path& folder = ".",
                  const LogSink& log = {});

/// Reads a scene (docs/user/scene-files.md). Unknown keys are errors with their line. Throws Error.
Scene readScene(const std::filesystem::path& path, const LogSink& log = {});

/// The scene as TOML text that readScene gives back equal; lengths with units, models by path or name.
std::string sceneToToml(const Scene& scene);
void writeScene(const Scene& scene, const std::filesystem::path& path);

}  // namespace lychnite
