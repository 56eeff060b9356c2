#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "lychnite/base/progress.h"
#include "lychnite/image/image.h"
#include "lychnite/scene/scene.h"
#include "lychnite/scene/settings.h"

namespace lychnite {

/// How the light inside is computed (docs/volume.md).
struct VolumeSettings {
  int cells = 64;           ///< along each object's longest side, 8..192
  int collisions = 6;       ///< of each photon, traced before the diffusion equation takes over, 1..64
  int photons = 1 << 16;    ///< of each light onto each object in one pass, 1024..2^24
  double tolerance = 0.01;  ///< relative residual of the diffusion solve, in (0, 1)
  uint64_t seed = 1;
  bool operator==(const VolumeSettings&) const = default;
};

/// Cells for a still picture: 64, and 96 where a translucent object is longer than 64 of its reduced mean
/// free paths (mean of RGB), so that a cell would be longer than one.
int volumeCells(const Scene& scene);

/// Cells for pictures of what moves (docs/volume.md has the error against the cost).
inline constexpr int kLiveVolumeCells = 40;

/// What the last update() did and cost.
struct VolumeStats {
  double geometryMs = 0, sourceMs = 0, solveMs = 0, exchangeMs = 0;  ///< 0 for what was kept
  size_t cells = 0, nodes = 0, samples = 0, memoryBytes = 0;         ///< of all objects
  int passes = 0;                                                    ///< of photons in the picture
  int iterations = 0;                                                ///< of the solver, all lights and rounds
  double flights = 0, rays = 0;  ///< of all passes since the last update(), lights that were traced again
  /// Shares of the light that enters, all lights and objects, per channel: leaves after scattering, absorbed,
  /// leaves unscattered, lost in holes and on opaque bodies inside. 1 together up to noise and the residual.
  Rgb left{0}, absorbed{0}, unscattered{0}, lost{0};
};

/// The light inside closed objects: first collisions and the diffusion equation on a grid of cells for a
/// picture at once, photons for what that is wrong by. Keeps what stays valid from scene to scene: the
/// geometry while shapes stay, traced light while lights, materials and sizes stay, solutions as first
/// guesses; lights' intensities and colours cost nothing. Deterministic: same calls, same result, on any
/// number of threads. Not for several threads at once. Work runs on the calling TBB arena.
class VolumeSolver {
 public:
  VolumeSolver();
  ~VolumeSolver();
  VolumeSolver(VolumeSolver&&) noexcept;
  VolumeSolver& operator=(VolumeSolver&&) noexcept;

  /// "" when every translucent object of the scene has an inside; else which one has none and why (open, or
  /// turned inside out in part). Cheap for meshes seen before.
  std::string obstacle(const Scene& scene);

  /// Solves for a scene whose obstacle() is "": a picture without photons and noise, of what is new; what is
  /// not keeps its photons. Throws Error for what validate() refuses, out-of-range settings and point lights
  /// inside an object, Interrupted
  /// (what was not done is done by the next update()).
  void update(const Scene& scene, const VolumeSettings& settings, const Progress& progress = {});

  /// Spends the photons that are to come where a picture of the last update's scene with these settings shows
  /// them, until the next update().
  void aim(const RenderSettings& settings);

  /// One more pass of photons over all lights: their noise falls with the root of the passes.
  void refine(const Progress& progress = {});

  /// Which orders of scattering a radiosity holds.
  enum class Orders { kAll, kFirst, kMultiple };

  /// Radiosity of an object (translucent) at its mesh's vertices, from the last update, irradiance units.
  std::vector<glm::vec3> vertexRadiosity(int object, Orders orders) const;

  /// The same at any points of it.
  std::vector<glm::vec3> pointRadiosity(int object, const std::vector<MeshPoint>& points,
                                        Orders orders) const;

  /// Noise of the radiosity as far as it is the photons', on all of the surface, or in the picture that they
  /// are aimed at: standard error over mean, told by two halves of the photons. 0 without photons.
  double noise() const;

  /// How carefully a picture's single scattering is summed up, and shadows' edges on large objects.
  enum class Detail {
    kPreview,  ///< in a tenth of the time: 3 to 5 % off by pixel, 6 to 8 % at edges, shadows inside softened
               ///< by some pixels; as kFull where that is kept. One look a pixel for shadows' edges
    kFull
  };

  /// The picture of the last update: settings' size, components, aovs, seed; conventions of
  /// renderReference(). `multiple` is order two and up; "radiosity" all orders; "stderr" that of `multiple`,
  /// 0 without photons. What the camera sees is kept, up to 512 MiB of it besides some 150 bytes a pixel, and
  /// single scattering too: the next picture of another light, medium or size by the same camera, or of more
  /// photons, is made in a fraction of the time.
  Image picture(const RenderSettings& settings, const Progress& progress = {},
                Detail detail = Detail::kFull) const;

  /// Whether picture() would find what the camera sees kept from the last one.
  bool keepsView(const RenderSettings& settings) const;

  /// update(), refine() and picture(), on settings.threads; with the statistics as metadata "volume.*". As
  /// many passes as settings.passes, or where they are given until settings.noise or settings.timeLimit is
  /// reached.
  Image render(const Scene& scene, const RenderSettings& settings, const Progress& progress = {});

  const VolumeStats& stats() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lychnite
