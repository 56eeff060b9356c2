#pragma once

#include <map>
#include <memory>
#include <vector>

#include "lychnite/volume/volume.h"
#include "reference/single_light.h"
#include "volume/gather.h"
#include "volume/light_field.h"
#include "volume/radiosity.h"
#include "volume/view.h"

namespace lychnite {

/// All that a VolumeSolver keeps, and how its parts are put together.
struct VolumeSolver::Impl {
  VolumeSettings settings;
  std::map<const Mesh*, std::shared_ptr<const volume::Shape>> shapes;
  std::map<const Mesh*, std::pair<std::weak_ptr<const Mesh>, double>> undefined;
  std::unique_ptr<RayScene> rays;
  volume::World world;
  std::vector<Coefficients> media;  ///< per object and scene unit, that the fields were made for
  std::unique_ptr<volume::Exchange> exchange;
  std::vector<volume::LightField> fields;
  std::vector<std::unique_ptr<volume::Gather>> gathers;
  std::vector<std::unique_ptr<volume::LastFlight>> lastFlights;
  std::unique_ptr<volume::View> view;  ///< of the last picture
  volume::Aim aim;                     ///< of the photons; empty for none
  struct Single {                      ///< of the last picture that shows it
    std::vector<RayLight> lights;
    std::vector<Coefficients> media;
    uint64_t seed = 0;
    bool full = false;
    std::vector<glm::vec3> radiance;
  } single;
  VolumeStats stats;

  double undefinedOf(const std::shared_ptr<const Mesh>& mesh);
  std::shared_ptr<const volume::Shape> shapeOf(const std::shared_ptr<const Mesh>& mesh);
  bool makeBodies(const Scene& scene, const VolumeSettings& next);
  bool makeOrForgetBodies(const Scene& scene, const VolumeSettings& next, const Progress& progress);
  void refuseLightsInside() const;
  int passes() const;  ///< that the picture is made of
  volume::LightSolver lightSolver() { return {world, lastFlights, *exchange, aim, settings, stats}; }
  void tell();
  template <class Add>
  void forLights(size_t object, Add add) const;
  volume::NodeEstimate estimate(size_t object) const;
  double photonDensity(size_t object) const;
  volume::FirstOrder firstOrder(size_t object, const std::vector<volume::Lanes>& entering) const;
  volume::NodeFlux flux(int object, Orders orders) const;
  glm::vec3 takeFine(size_t object, Orders orders,
                     std::vector<volume::Lanes>& flux) const;  ///< as the view sees it
  void refine(bool last, const Progress& progress);
  void aimAt(const RenderSettings& wish);
  volume::View& viewOf(int width, int height);
  const std::vector<glm::vec3>& singleOf(uint64_t seed, Detail detail, const Progress& progress);
  void converge(VolumeSolver& solver, const RenderSettings& wish, const Progress& progress);
};

}  // namespace lychnite
