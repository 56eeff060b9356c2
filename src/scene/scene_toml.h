#pragma once

#include <filesystem>
#include <string>

#include "lychnite/base/log.h"
#include "lychnite/scene/scene.h"

namespace lychnite {

/// Parses a scene's text. `path` names it in errors ("path:line") and gives the folder models are relative
/// to.
Scene sceneFromToml(const std::string& text, const std::filesystem::path& path, const LogSink& log);

}  // namespace lychnite
