#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "lychnite/base/log.h"
#include "lychnite/base/vec.h"
#include "reference/ray_scene.h"
#include "reference/transport.h"
#include "reference/walk_distance.h"
#include "reference/walk_emission.h"
#include "reference/walk_fan.h"
#include "reference/walk_film.h"
#include "reference/walk_guide.h"

namespace lychnite {

/// What all photons of a walk share; immutable while they fly.
struct WalkWorld {
  const RayScene* rays = nullptr;
  const WalkEmission* emission = nullptr;
  const WalkLens* lens = nullptr;
  std::vector<transport::Medium> media;                 ///< per object, scene units
  std::vector<float> lobeScale;                         ///< per object, 1 / (pi C(eta)) of S_w
  std::vector<std::unique_ptr<WalkDistance>> distance;  ///< per object; none for opaque ones
  std::vector<char> closed;                             ///< per object
  float fluxUnit = 1;                                   ///< what a photon carries on average, mean of RGB
  bool radiosity = false;                               ///< the film has layer 1
};

/// For a scene, without lens. Warns of meshes that are not closed. Keeps references.
WalkWorld makeWalkWorld(const RayScene& rays, const WalkEmission& emission, const LogSink& log);

/// Light that leaves a surface after at least one collision, as expected where a photon meets it.
struct WalkExit {
  int object;
  MeshPoint point;
  glm::vec3 flux;
};

/// Where the power of some photons went: sums of flux.
struct WalkTally {
  double photons = 0;
  Rgb arrived{0};   ///< at translucent surfaces, straight from the lights
  Rgb escaped{0};   ///< away from all objects
  Rgb absorbed{0};  ///< in the media (expected values)
  Rgb blocked{0};   ///< on opaque objects
  Rgb lost{0};      ///< through holes of meshes that are not closed, and numerical leaks
  Rgb ended{0};     ///< by Russian roulette, less what the survivors got for it: 0 on average
  double rays = 0, collisions = 0, fans = 0;  ///< work done

  WalkTally& operator+=(const WalkTally& other);
  double cost() const;  ///< of the work, in fans
};

/// Flies photons one after the other. Exits of light from its last collision are splatted in expectation, by
/// fans of rays from collisions (as many as WalkGuide says); those after an internal reflection where they
/// happen. Photons that come to where the picture is decided are split, others ended by chance (WalkGuide).
class WalkPhotons {
 public:
  WalkPhotons(const WalkWorld& world, const WalkGuide& guide, WalkFilm* film, WalkGuideSamples* learn,
              transport::Rng rng)
      : world_(world), guide_(guide), film_(film), learn_(learn), rng_(rng) {}

  /// Appends all that leaves from now on to `exits`, seen or not.
  void keepExits(std::vector<WalkExit>* exits) { exits_ = exits; }
  /// One photon for the start at `u` in [0, 1), drawn by `channel`.
  void fly(double u, int channel);
  const WalkTally& tally() const { return tally_; }

 private:
  void stepOutside();
  void stepInside();
  void arrive(const RayHit& hit);
  void collide(float distance);
  void meet(const RayHit& hit);
  void leave(const RayHit& hit, float cosI);
  bool survives(float threshold);
  bool splitOrEnd();
  void takeTwin();
  void afterCollision();
  void goOn();
  void openFan();
  void splatFan(float expected, float reach);
  RayFan followed(const RayFan& fan);
  void splatExits(const RayFan& fan, float expected, float reach);
  void learnSplat(int64_t pixel, const glm::vec3& direction, float value, float each, float reach);
  float splat(const RayHit& hit, const WalkLens::Seen& seen, const glm::vec3& flux);
  void splatIfSeen(const RayHit& hit, const glm::vec3& flux);
  void learnPassed(float cost);
  void learnPhoton(const WalkEmission::Start& start, float cost);
  void lose() {
    tally_.lost += Rgb(weight_.flux());
    alive_ = false;
  }
  const transport::Medium& medium() const { return world_.media[size_t(object_)]; }
  float leastExtinction() const {
    const glm::vec3& s = medium().sigma_t;
    return std::fmin(s.x, std::fmin(s.y, s.z));
  }
  int firstOrder() const { return world_.radiosity ? 1 : 2; }

  const WalkWorld& world_;
  const WalkGuide& guide_;
  WalkFilm* film_;
  WalkGuideSamples* learn_;
  std::vector<WalkExit>* exits_ = nullptr;
  transport::Rng rng_;
  WalkTally tally_;
  RayFan fan_;
  int byPhase_ = RayFan::kMost;  ///< the first rays of the fan, drawn by the phase function

  transport::PathWeight weight_;
  glm::vec3 position_{0}, direction_{0};
  int object_ = -1;     ///< whose medium the photon is in; -1 outside
  int shells_ = 1;      ///< how many nested shells of that object it is in
  int order_ = 0;       ///< collisions so far
  int ahead_ = -1;      ///< entry of fan_ that the photon flies along; -1 none
  int mirrorings_ = 0;  ///< since the last collision: while they are few, its fans account for the exit
  bool alive_ = false;
  float clear_ = -1;  ///< distance known to be clear about the position; below 0 unknown
  /// Splats of this photon, kept only while learning.
  struct Splat {
    int64_t pixel;
    int source;  ///< number of its fan, from 1; 0 for none
    float value;
    float stands;  ///< 1 / expected number of its fans
  };
  std::vector<Splat> splats_;
  int sources_ = 0;
  /// Collisions of this photon, kept only while learning.
  struct Passed {
    glm::vec3 position;
    float weight, squares, cost;  ///< squares and cost: of the photon until then
  };
  std::vector<Passed> passed_;
  double startCost_ = 0;
  float squares_ = 0;  ///< of its splats so far
  /// A photon that waits for its turn after a splitting.
  struct Twin {
    transport::PathWeight weight;
    glm::vec3 position, direction;
    int object, shells, order;
  };
  std::vector<Twin> twins_;
};

}  // namespace lychnite
