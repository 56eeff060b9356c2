#include "volume/aim.h"

#include <algorithm>
#include <cmath>

namespace lychnite::volume {

namespace {

constexpr double kTolerance = 0.1;  // of the solve: what is looked for is where, not how much

/// Of each node: what a unit of the square of a photon's flux that leaves there adds to the picture's, and
/// how much of the picture it is.
struct Seen {
  std::vector<std::vector<Lanes>> squares;
  std::vector<std::vector<float>> share;
};

Seen seenBy(View& view, const World& world) {
  Seen seen;
  std::vector<uint32_t> firstNode;
  uint32_t nodes = 0;
  for (const auto& body : world.bodies) {
    const size_t own = body ? body->shape->surface.nodes().size() : 0;
    firstNode.push_back(nodes);
    seen.squares.emplace_back(own, Lanes{0, 0, 0, 0});
    seen.share.emplace_back(own, 0.0f);
    nodes += uint32_t(own);
  }
  view.forKeptPixels([&](const View::Pixel& pixel) {
    size_t body = 0;
    for (const View::Share& share : pixel.shares) {
      while (body + 1 < firstNode.size() && share.node >= firstNode[body + 1]) ++body;
      const uint32_t node = share.node - firstNode[body];
      const float square = share.radiance * share.radiance;
      seen.squares[body][node] += Lanes{square, square, square, 0};
      seen.share[body][node] += share.radiance * world.bodies[body]->shape->surface.nodes()[node].area;
    }
  });
  return seen;
}

/// What enters at a node comes out about there, by the layer, and wherever diffusion takes it, which the
/// symmetric equation tells from the other end: its solution for a source where light is seen.
std::vector<float> importance(const Body& body, const std::vector<Lanes>& squares) {
  const Surface& surface = body.shape->surface;
  std::vector<Lanes> Q, phi;
  body.system.sourcesOfExits(squares, Q);
  body.system.solve(Q, phi, kTolerance);
  std::vector<float> result(squares.size(), 0), depth(squares.size(), 0);
  for (const auto& sample : surface.samples())
    if (sample.cell != Grid::kNone) depth[sample.node] += sample.area * sample.depth;
  for (size_t n = 0; n < result.size(); ++n) {
    const auto& node = surface.nodes()[n];
    if (node.cell == Grid::kNone || !(node.area > 0)) continue;
    for (int c = 0; c < 3; ++c) {
      const Diffusion& diffusion = body.system.medium().channel[c];
      const double d = double(depth[n] / node.area), z = std::min(d, 1 / diffusion.sigma_tp);
      result[n] += float(diffusion.albedo_p) * (float(diffusion.leaving(z, d)) * squares[n][c] +
                                                float(diffusion.staying(z, d)) * phi[node.cell][c]);
    }
    result[n] = std::sqrt(std::max(0.0f, result[n]));
  }
  return result;
}

}  // namespace

Aim aimAt(View& view, const World& world) {
  Seen seen = seenBy(view, world);
  Aim aim;
  for (size_t i = 0; i < world.bodies.size(); ++i)
    aim.importance.push_back(world.bodies[i] ? importance(*world.bodies[i], seen.squares[i])
                                             : std::vector<float>());
  aim.seen = std::move(seen.share);
  return aim;
}

}  // namespace lychnite::volume
