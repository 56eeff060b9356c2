#pragma once

#include <string>

#include "lychnite/image/metrics.h"
#include "lychnite/mesh/load.h"
#include "lychnite/optics/materials.h"
#include "lychnite/scene/settings.h"
#include "lychnite/technique/renderer.h"

namespace lychnite {

// The machine-readable texts of docs/user/machine-output.md: keys stay, new ones may be added.

/// `render --stats`. `stats` is null for a judge's picture.
std::string statsJson(const Image& image, const RenderSettings& settings, const RenderStats* stats,
                      double seconds);
/// `compare --json`.
std::string comparisonJson(const Comparison& comparison);
/// `info --json`.
std::string infoJson(const std::string& model, const MeshInfo& info, const LoadedMesh* loaded);
/// `materials --json`.
std::string materialsJson();

/// Largest resident memory of this process so far, bytes.
size_t peakMemoryBytes();

}  // namespace lychnite
