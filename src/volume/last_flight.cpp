#include "volume/last_flight.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "volume/emission.h"

namespace lychnite::volume {

namespace {

constexpr size_t kRays = 4;                                                                // of a node
constexpr double kStep[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};  // Roberts 2018
// Cells thinner than this many mean free paths are seen through, thicker than that not at all.
constexpr float kThin = 0.7f, kThick = 2.1f;
constexpr double kPath = 1.5,
                 kWidest = 8;  // what diffusion says is kept above so many mean free paths, voxels

float turn(double x) {
  return std::fmin(float(x - std::floor(x)), 0.99999994f);
}

}  // namespace

LastFlight::LastFlight(const World& world, size_t object) : eta_(world.bodies[object]->medium.eta) {
  Interruptible::check();
  const Body& body = *world.bodies[object];
  const Surface& surface = body.shape->surface;
  const auto& samples = surface.samples();
  // A node's rays start from its samples, taken in turn.
  std::vector<uint32_t> sampleOf(surface.nodes().size(), 0);
  for (uint32_t s = 0; s < samples.size(); ++s) sampleOf[samples[s].node] = s;
  rays_.resize(sampleOf.size() * kRays);
  const float eta = eta_;
  const float least2 = eta > 1 ? 1 - 1 / (eta * eta) : 0;  // square of the least cosine that leaves
  tbb::parallel_for(size_t(0), sampleOf.size(), [&](size_t n) {
    const RayHit from = middleOf(world, object, sampleOf[n]);
    for (size_t k = 0; k < kRays; ++k) {
      Ray& ray = rays_[n * kRays + k];
      const double i = double(n * kRays + k) + 0.5;
      const float cosine = std::sqrt(least2 + (1 - least2) * turn(i * kStep[0]));
      const glm::vec3 direction =
          transport::deflected(-from.normal, cosine, 2 * transport::kPi * turn(i * kStep[1]));
      ray.from = body.toLocal(from.position);
      ray.direction = body.turnBack * direction;
      ray.transmittance = (1 - least2) * (1 - transport::fresnel(cosine, 1 / eta).reflectance);
      const RayHit hit = world.rays->nearestInside(int(object), offPoint(from, direction), direction);
      if (!hit) continue;
      ray.length = hit.distance / body.size;
      if (hit.object != int(object)) continue;
      const float cosI = std::fmin(1.0f, glm::dot(direction, hit.normal));
      ray.mirrored = cosI > 0 ? transport::fresnel(cosI, 1 / eta).reflectance : 1;
      ray.end = samples[surface.sampleAt(hit.triangle, hit.u, hit.v)].cell;
    }
  });
}

void LastFlight::gather(const Body& body, const std::vector<Lanes>& phi, const std::vector<Lanes>& Q,
                        std::vector<Lanes>& exits) const {
  const Surface& surface = body.shape->surface;
  const Grid& grid = body.shape->grid;
  const glm::vec3 sigma_t = glm::max(body.reduced.sigma_t * body.size, glm::vec3(1e-6f)),
                  sigma_s = body.reduced.sigma_s * body.size;
  const glm::vec3 share = 1.0f - glm::smoothstep(kThin, kThick, sigma_t * float(grid.side()));
  if (!(share.x + share.y + share.z > 0)) return;
  const Lanes scatters{sigma_s.x, sigma_s.y, sigma_s.z, 0};
  std::vector<Lanes> gathered(exits.size());
  tbb::parallel_for(size_t(0), exits.size(), [&](size_t n) {
    Lanes sum{0, 0, 0, 0};
    for (size_t k = 0; k < kRays; ++k) {
      const Ray& ray = rays_[n * kRays + k];
      const size_t i = n * kRays + k;
      const glm::vec3 past = glm::exp(-sigma_t * ray.length);
      const glm::vec3 stopped = glm::max(1.0f - past, glm::vec3(1e-6f));
      // One distance drawn for each channel; all serve all by the balance heuristic, scaled so that a
      // constant is exact.
      Lanes seen{0, 0, 0, 0}, weights{1e-20f, 1e-20f, 1e-20f, 1};
      for (int drawn = 0; drawn < 3; ++drawn) {
        const float u = turn((double(i) * 3 + drawn + 0.5) * kStep[2]);
        const float s = std::fmin(-std::log1p(-u * stopped[drawn]) / sigma_t[drawn], ray.length);
        const glm::vec3 passed = glm::exp(-sigma_t * s);
        const glm::vec3 densities = sigma_t * passed / stopped;
        const glm::vec3 w = passed / (densities.x + densities.y + densities.z);
        const Lanes weight{w.x, w.y, w.z, 0};
        weights += weight;
        const uint32_t cell = grid.find(ray.from + s * ray.direction);
        if (cell == Grid::kNone) continue;
        seen += weight * (scatters * phi[cell] + Q[cell] / grid.cell(cell).volume);
      }
      for (int c = 0; c < 3; ++c) {
        float L = stopped[c] / sigma_t[c] * seen[c] / weights[c];
        if (ray.end != Grid::kNone) L += past[c] * ray.mirrored * phi[ray.end][c];
        sum[c] += ray.transmittance * L;
      }
    }
    gathered[n] = sum * (surface.nodes()[n].area / float(4 * kRays));
  });
  // Detail by straight lines, all that is wider than mean free paths by diffusion, which keeps energy.
  std::vector<Lanes> rest(exits.size());
  const Lanes kept{share.x, share.y, share.z, 0};
  for (size_t n = 0; n < exits.size(); ++n) rest[n] = kept * (exits[n] - gathered[n]);
  const auto width = [&](double q, int c) {
    const double w = std::min(kPath / (double(sigma_t[c]) * grid.side()), kWidest);
    return std::exp(-0.5 * w * w * q * q);
  };
  const auto smooth = body.shape->smoother.filtered({{rest, {body.shape->smoother.filter(width)}}});
  for (size_t n = 0; n < exits.size(); ++n) exits[n] += smooth[0][0][n] - rest[n];
}

}  // namespace lychnite::volume
