#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "reference/ray_scene.h"
#include "reference/transport.h"
#include "volume/body.h"
#include "volume/interruptible.h"

namespace lychnite::volume {

/// Where light ends that was traced, in one body: flux per node and per cell. Scene units.
struct Deposits {
  std::vector<Lanes> first;   ///< leaves at each node after one collision
  std::vector<Lanes> later;   ///< after two or more
  std::vector<Lanes> layer;   ///< is sent out at once by the exit layer, in no direction that is known
  std::vector<Lanes> source;  ///< goes on in each cell as a source of the diffusion equation
  Deposits() = default;
  explicit Deposits(const Body& body);
  Deposits& operator+=(const Deposits& other);
  void scale(float factor);
};

/// Sums of flux: where traced light went.
struct Tally {
  Rgb arrived{0};      ///< at surfaces, straight from the light
  Rgb entered{0};      ///< of it, and again after leaving
  Rgb unscattered{0};  ///< left the body it was in without a collision
  Rgb left{0};         ///< with one collision or more, exit layer included
  Rgb absorbed{0};     ///< at collisions and in the exit layer
  Rgb source{0};       ///< handed over to the diffusion equation
  Rgb lost{0};         ///< on opaque bodies inside, through holes, beyond the last mirroring
  double flights = 0, rays = 0;
  Tally& operator+=(const Tally& other);
};

/// The bodies and how light is followed in them.
struct World {
  const RayScene* rays = nullptr;
  std::vector<std::unique_ptr<Body>> bodies;  ///< one an object; null for opaque ones
  bool returns = true;                        ///< light that leaves can meet a surface again
};

/// What a photon carries, see transport::PathWeight, of which this is the form for forced collisions: flights
/// never leave; what would have left is deposited in expectation.
struct Photon {
  glm::vec3 position{0}, direction{0};
  glm::vec3 flux{0}, density{1};
  float arrived = 0;                                         ///< largest flux that it began with
  float descent = 1;                                         ///< cosine of the way in to the normal
  float thickness = std::numeric_limits<float>::infinity();  ///< of the object where it came in, scene units
  int channel = 0;
  int object = -1;     ///< -1 outside
  int order = 0;       ///< collisions so far
  int collisions = 1;  ///< to be traced, of a medium of g = 0
  int branch = 0;      ///< generations of branches off the first path
};

/// Follows photons one after the other; deterministic for the random numbers given.
class Tracer {
 public:
  struct Record {
    enum Kind : uint8_t { kFirst, kLater, kLayer, kSource };
    uint32_t index;
    uint16_t object;
    Kind kind;
    glm::vec3 flux;
  };
  /// Throws Interrupted, see Interruptible.
  Tracer(const World& world, std::vector<Record>& records) : world_(world), records_(records) {
    Interruptible::check();
  }

  /// Light of `flux` that travels along `direction` and meets the front of a surface. `drawn` in [0, 1)
  /// draws the channel of its path, `u` are the numbers in [0, 1) of its first flight and first scattering,
  /// `order` the collisions that it has behind it, `collisions` how many more are traced before the diffusion
  /// equation takes over, at least 1.
  void arrive(const RayHit& hit, const glm::vec3& direction, const glm::vec3& flux, float drawn,
              const glm::vec3& u, transport::Rng rng, int order, int collisions);
  const Tally& tally() const { return tally_; }

 private:
  void enter(Photon photon, const RayHit& hit);
  void fly(Photon photon);
  bool deep(const Photon& photon) const;
  bool advance(Photon& photon, const transport::Medium& medium, float u);
  enum class Outcome { kCollided, kGoesOn, kGone };
  Outcome meet(Photon& photon, const transport::Medium& medium, const RayHit& hit, float& u);
  bool collide(Photon& photon, const transport::Medium& medium, float distance, const glm::vec3& total);
  void leave(const Photon& photon, const RayHit& hit, const glm::vec3& flux, float share);
  void outside(Photon photon);
  void handOver(const Photon& photon);
  glm::vec3 strength(const Photon& photon, const Surface::Place& place) const;
  void separateFirst(const Photon& photon);
  const Body& body(const Photon& photon) const { return *world_.bodies[size_t(photon.object)]; }

  const World& world_;
  std::vector<Record>& records_;
  transport::Rng rng_{0, 0};
  Tally tally_;
  std::vector<Photon> waiting_;  ///< branches outside
  glm::vec3 firstNumbers_{0};
  int shells_ = 1;
};

/// Adds records to the deposits of their bodies, in order.
void collect(const std::vector<Tracer::Record>& records, std::vector<Deposits>& deposits);

}  // namespace lychnite::volume
