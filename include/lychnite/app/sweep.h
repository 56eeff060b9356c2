#pragma once

#include <filesystem>
#include <optional>

#include "lychnite/scene/scene.h"

namespace lychnite {

/// An animation of a scene: any of these at once, over `frames` pictures.
struct Sweep {
  int frames = 1;
  double orbitLightDegrees = 0;  ///< parallel lights turn about y by this much over the whole sweep
  double turntableDegrees = 0;   ///< objects turn about y through the origin
  /// All lengths of the scene are scaled so that the first translucent object goes from one size to the
  /// other, evenly in the logarithm; mm. Materials stay.
  std::optional<double> sizeFrom, sizeTo;
};

/// Throws Error (Kind::kUsage): frames below 1, one end of the sizes missing or not above zero.
void validate(const Sweep& sweep);

/// The scene of frame `index` in [0, frames). A whole turn ends one step before it began, a size sweep at its
/// end.
Scene sceneAt(const Scene& scene, const Sweep& sweep, int index);

/// All lengths (sizes, positions, the camera) times `factor`, point lights' intensities by its square, so
/// that the picture changes by what the materials make of the size and by nothing else.
Scene scaledScene(const Scene& scene, double factor);

/// "out.png" -> "out_0001.png" for index 0; as many digits as the sweep needs, four at least.
std::filesystem::path numbered(const std::filesystem::path& path, int index, int frames);

}  // namespace lychnite
