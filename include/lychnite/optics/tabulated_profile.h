#pragma once

#include <memory>
#include <vector>

#include "lychnite/optics/profile.h"

namespace lychnite {

/// Light that leaves a half-space around a pencil beam, as Monte Carlo transport measured it, per unit of
/// *entered* power. Lengths in mean free paths 1/sigma_t of each channel, so that one measurement serves
/// every medium of that albedo, g and eta at every size.
struct MeasuredProfile {
  /// One selection of orders of scattering.
  struct Part {
    Rgb total{0};                ///< the whole exitance
    std::vector<Rgb> exitance;   ///< mean over each ring, per square mean free path
    std::vector<Rgb> deviation;  ///< its standard error
    bool operator==(const Part&) const = default;
  };
  std::vector<double> ringEdges;  ///< rising from 0; ring i spans [ringEdges[i], ringEdges[i + 1])
  Part all, fromSecond;
  bool operator==(const MeasuredProfile&) const = default;
};

/// A smooth profile through the rings of one part: its ratio to a dipole of the medium's true decay length is
/// smoothed over the logarithm of r (Whittaker's smoother, by the rings' standard errors), and the whole
/// scaled to the measured total. Rd is constant below a two-hundredth of a reduced mean free path, where its
/// mean is kept. Channels with sigma_s = 0 are 0.
std::unique_ptr<Profile> makeTabulated(const MeasuredProfile& measured, ProfileOrders orders,
                                       const Coefficients& medium);

}  // namespace lychnite
