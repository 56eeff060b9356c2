#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lychnite/optics/profile.h"

namespace lychnite {

/// Every --method: the real-time ones (technique/), the CPU judges (reference/), and the solver (volume/).
/// kAuto is the best that whoever renders has for the scene: of ImageMaker see resolved(), and matched where
/// an object has no inside; of Renderer matched.
enum class Method { kMatched, kAdaptive, kFixed, kDipole, kHierarchical, kWalk, kVolume, kAuto };
Method parseMethod(std::string_view name, std::string_view where);  ///< throws Error with the nearest name;
                                                                    ///< knows no "auto"
std::string methodName(Method method);
bool isReference(Method method);  ///< rendered by reference/ on the CPU

/// Which parts of the light are added up.
struct Components {
  bool multiple = true, single = true, surface = true;
};
Components parseComponents(std::string_view list, std::string_view where);
std::string componentsName(const Components& components);

/// The constants of the paper's lattice (Yao & Wang 2009 eq. 4), which it leaves to experiment. They act only
/// through C1 K and C2 K, so K stays 1. The defaults are tools/fit_lattice's, see docs/sampling.md for its
/// sizes, materials and remaining error.
struct LatticeConstants {
  double C1 = 1.5, C2 = 0.375, K = 1;
};

/// How a Scene is rendered, the same structure for every method; each reads what concerns it.
struct RenderSettings {
  int width = 600, height = 600;  ///< 1..16384
  Method method = Method::kAuto;
  ProfileKind profile = ProfileKind::kDipole;
  Components components;
  int multipleSamples = 24;  ///< matched: at a surface that faces the light, 8..128
  /// matched: largest relative difference between neighbouring evaluations that is interpolated across, 0..1;
  /// twice as much where they are near beside the profile's core; 0 evaluates every pixel for itself.
  double interpolation = 0.08;
  LatticeConstants lattice;  ///< adaptive, fixed
  int singleSamples = 8;     ///< along the refracted ray (real-time methods), 1..256
  int mapSize = 512;         ///< light-space map, 128..4096
  /// matched: the map is doubled, up to this, while a texel is longer than a quarter of an object's reduced
  /// mean free path (mean of RGB); mapSize keeps it as it is.
  int mostMapSize = 2048;
  double samples = 16;       ///< walk: photons per pixel
  double tolerance = 0.005;  ///< dipole: relative error to refine to
  double timeLimit = 0;      ///< walk, volume: seconds, 0 = none
  double noise = 0;          ///< walk, volume: relative noise to stop at, 0 = none
  int cells = 0;             ///< volume: along each object's longest side, 8..192; 0 = volumeCells()
  int collisions = 6;        ///< volume: traced before the diffusion equation takes over, 1..64
  int passes = 6;            ///< volume: of photons, 1..10000
  uint64_t seed = 1;
  int threads = 0;  ///< 0 = all cores
  /// Layers beside colour and alpha: multiple, single, surface, depth, normal, lights, radiosity, stderr.
  std::vector<std::string> aovs;
  bool wants(std::string_view aov) const;
};

/// What kAuto stands for: volume, or matched where layers are asked for that only it has.
Method resolved(const RenderSettings& settings);

/// Throws Error (Kind::kUsage) for numbers out of range, aovs unknown or not offered by the method.
void validate(const RenderSettings& settings);

}  // namespace lychnite
