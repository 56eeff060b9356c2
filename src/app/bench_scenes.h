#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "lychnite/base/log.h"
#include "lychnite/scene/scene.h"

namespace lychnite::bench {

struct Model {
  const char *name, *file, *source;  ///< file and source are null for the built-in ones
};
/// Those of Table 1 (the built-in ones stand in for its stone, candle and Aphrodite), and the knot.
std::span<const Model> models();

/// What to do for a row of `model` before it can be measured; empty for nothing.
std::string missingText(const Model& model, const std::filesystem::path& folder);

/// One object, 20 mm of marble, one parallel light.
Scene sceneOf(const Model& model, const std::filesystem::path& folder, const LogSink& log);

/// Frame `index` of a scene under a kind of change, the same in every run: "all": another light, size (10 to
/// 40 mm) and material (marble to skin1) than the frame before; "light": another light; "camera": another
/// camera.
Scene changed(const Scene& base, const std::string& change, int index);

}  // namespace lychnite::bench
