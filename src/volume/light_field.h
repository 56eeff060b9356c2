#pragma once

#include "lychnite/volume/volume.h"
#include "volume/aim.h"
#include "volume/beam.h"
#include "volume/exchange.h"
#include "volume/last_flight.h"

namespace lychnite::volume {

/// What one light of power 1 makes of the scene. Fluxes that leave are per body and node.
struct LightField {
  using Fluxes = std::vector<std::vector<Lanes>>;
  RayLight light;  ///< made for
  // By first collisions alone, without noise.
  std::vector<Entering> entering;  ///< empty before anything is made
  Beamed beamed;
  Fluxes phiBeam;          ///< solution, kept as first guess
  Fluxes beam, beamFirst;  ///< all orders, first order
  // By photons.
  std::vector<Emission> emission;     ///< of each body; empty to be found anew
  std::vector<double> density;        ///< of the photons so far in each body, see Emission::density()
  int passes = 0, solved = 0;         ///< traced, and solved for
  std::vector<Deposits> deposits[2];  ///< by two halves, of independent photons: sums over the passes
  Tally tally;
  Fluxes phi[2];
  Fluxes all[2], first[2];
  // Light that leaves, meets a surface and leaves again, as far as photons have not followed it themselves.
  Fluxes beamAgain, again;  ///< of what leaves by beams; by photons and diffusion
  int exchangedAt = 0;      ///< passes, of `again`
  Rgb absorbed{0};

  /// Of all that the light did: by photons as soon as there are any, per pass.
  const Tally& told() const { return solved > 0 ? tally : beamed.tally; }
  double passesTold() const { return std::max(1, solved); }
};

/// Brings a light's field on: first collisions, photons, diffusion, what enters again.
class LightSolver {
 public:
  LightSolver(const World& world, const std::vector<std::unique_ptr<LastFlight>>& lastFlights,
              const Exchange& exchange, const Aim& aim, const VolumeSettings& settings, VolumeStats& stats)
      : world_(world),
        lastFlights_(lastFlights),
        exchange_(exchange),
        aim_(aim),
        settings_(settings),
        stats_(stats) {}

  void beam(LightField& field);   ///< begins anew, without photons
  void trace(LightField& field);  ///< one more pass of photons
  void solve(LightField& field);  ///< for all photons so far

 private:
  void solveHalves(LightField& field, size_t body);
  LightField::Fluxes lightThatReturns(LightField::Fluxes leaving, int oneOf);
  struct Returned {
    LightField::Fluxes all, scattered;  ///< the latter is not followed yet
  };
  Returned returnedOnce(const LightField::Fluxes& leaving, int round, int oneOf);

  const World& world_;
  const std::vector<std::unique_ptr<LastFlight>>& lastFlights_;
  const Exchange& exchange_;
  const Aim& aim_;  ///< empty for none
  const VolumeSettings& settings_;
  VolumeStats& stats_;
};

}  // namespace lychnite::volume
