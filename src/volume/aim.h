#pragma once

#include "volume/view.h"

namespace lychnite::volume {

/// What photons are spent on: for each body and node how much a photon that enters there adds to the noise of
/// a picture, standard deviation over flux, up to a factor; and how much of the picture the node is. Empty
/// for opaque bodies; no bodies for no picture.
struct Aim {
  std::vector<std::vector<float>> importance, seen;
};

/// For what a view shows of the scene, in its media as they are.
Aim aimAt(View& view, const World& world);

}  // namespace lychnite::volume
