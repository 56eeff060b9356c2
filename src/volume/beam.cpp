#include "volume/beam.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace lychnite::volume {

namespace {

using transport::Medium;

constexpr size_t kBlock = 512;
constexpr float kNegligible = 8;  // mean free paths after which the rest of a beam collides where it is
constexpr float kLeastMirrored = 0.02f;  // of a beam, that is followed further
constexpr int kMostMirrorings = 16;
constexpr float kLeastColliding = 1e-6f;
constexpr float kSeenThrough = 0.25f;  // a cell of so many mean free paths
constexpr size_t kTogether = 4;        // nodes that share a beam there
constexpr float kAlike = 0.97f;        // least cosine between their normals
constexpr float kLongest = 0.6f;       // piece of a beam, in voxels
constexpr double kStep[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};  // Roberts 2018

float least(const glm::vec3& v) {
  return std::fmin(v.x, std::fmin(v.y, v.z));
}
float largest(const glm::vec3& v) {
  return std::fmax(v.x, std::fmax(v.y, v.z));
}
float turn(double x) {
  return std::fmin(float(x - std::floor(x)), 0.99999994f);
}

/// Follows beams one after the other.
class Beamer {
 public:
  /// Throws Interrupted, see Interruptible.
  Beamer(const World& world, std::vector<Tracer::Record>& records) : world_(world), records_(records) {
    Interruptible::check();
  }

  void follow(const RayHit& from, const Surface::Sample& sample, const glm::vec3& direction, float flux,
              size_t number, size_t looks);
  const Tally& tally() const { return tally_; }

 private:
  /// Where a beam is, local units.
  struct Beam {
    glm::vec3 position, direction;
    glm::vec3 flux;
  };
  const Body& body() const { return *world_.bodies[size_t(object_)]; }
  void enterLayer(Beam& beam, const Surface::Sample& sample, float cosine, float& length);
  glm::vec3 albedoAt(const glm::vec3& depth) const;
  void march(Beam& beam, float length);
  void collide(const glm::vec3& p, const glm::vec3& flux);
  void deposit(uint32_t cell, const glm::vec3& flux);
  void leave(uint32_t node, Tracer::Record::Kind kind, const glm::vec3& flux);
  bool meet(Beam& beam, const RayHit& hit, glm::vec3& onwards);
  void look(const RayHit& from, const glm::vec3& direction, float flux, float distance, size_t number);
  void lookFrom(const RayHit& from, const glm::vec3& direction, float flux, const glm::vec3& colliding,
                int channel, double number);

  const World& world_;
  std::vector<Tracer::Record>& records_;
  Tally tally_;
  int object_ = 0;
  int shells_ = 1;
  float entered_ = 0;               ///< flux of the beam
  glm::vec3 sigma_{0}, albedo_{0};  ///< of the reduced medium, local units
  // Of the slab that stands for the object here, local units. Past its far side, which may be nearer than the
  // object's, a beam counts as on it: to stretch the slab over the beam's way is a little worse
  // (docs/volume.md).
  float thickness_ = 0, depth_ = 0, descent_ = 0;
};

/// Light of `flux` that is refracted along `direction` at a point of `sample`; `number` of the beam, `looks`
/// for the first order.
void Beamer::follow(const RayHit& from, const Surface::Sample& sample, const glm::vec3& direction, float flux,
                    size_t number, size_t looks) {
  object_ = from.object;
  shells_ = 1;
  entered_ = flux;
  const Body& in = body();
  sigma_ = in.reduced.sigma_t * in.size;
  albedo_ = in.reduced.sigma_s / glm::max(in.reduced.sigma_t, glm::vec3(1e-20f));
  const glm::vec3 entered(flux);
  tally_.arrived += Rgb(entered);
  tally_.entered += Rgb(entered);
  const float far = kNegligible / std::fmax(least(in.reduced.sigma_t), 1e-6f);
  Beam beam{in.toLocal(from.position), in.turnBack * direction, entered};
  glm::vec3 start = offPoint(from, direction), onwards = direction;
  for (int mirrorings = 0; mirrorings < kMostMirrorings; ++mirrorings) {
    tally_.rays += 1;
    const RayHit hit = world_.rays->nearestInside(object_, start, onwards, far);
    float length = (hit ? hit.distance : far) / in.size;
    if (mirrorings == 0) {
      const float distance = hit ? hit.distance : std::numeric_limits<float>::infinity();
      for (size_t i = 0; i < looks; ++i)
        look(from, direction, flux / float(looks), distance, number * kTogether + i);
      depth_ = 0;
      descent_ = -glm::dot(direction, from.normal);
      thickness_ = std::fmin(length * descent_, in.thickness);
      enterLayer(beam, sample, descent_, length);
    }
    march(beam, length);
    if (!hit || !meet(beam, hit, onwards)) break;
    start = offPoint(hit, onwards);
    beam.position = in.toLocal(hit.position);
    beam.direction = in.turnBack * onwards;
  }
  if (!(largest(beam.flux) > 0)) return;
  collide(beam.position, beam.flux);
}

/// Share of what collides at a depth (of each channel) that is a source: as strong as diffusion needs it to
/// send out what transport does in a slab as thick as the object is here.
glm::vec3 Beamer::albedoAt(const glm::vec3& depth) const {
  glm::vec3 result = albedo_;
  for (int c = 0; c < 3; ++c) {
    const float nearer = std::fmax(0.0f, std::fmin(depth[c], thickness_ - depth[c]));
    result[c] *= 1 + body().slabs[c].excess(sigma_[c] * thickness_, sigma_[c] * nearer);
  }
  return result;
}

/// Down to the depth of the centroid under the sample, where the layer's integrals are known.
void Beamer::enterLayer(Beam& beam, const Surface::Sample& sample, float cosine, float& length) {
  if (sample.cell == Grid::kNone) return;
  cosine = std::fmax(cosine, 1e-4f);
  const float way = std::fmin(length, sample.depth / cosine);
  const double end = double(way * cosine), depth = std::max(end, double(sample.depth));
  const glm::vec3 pass = glm::exp(-sigma_ * way);
  glm::vec3 x;
  for (int c = 0; c < 3; ++c)
    x[c] = std::fmax(1e-2f, sigma_[c] * way + float(body().system.medium().channel[c].k * end));
  // Of the depths of collisions that light leaves from, over the layer's.
  const glm::vec3 through = glm::exp(-x), mean = 1.0f / x - through / (1.0f - through);
  const glm::vec3 albedo = albedoAt(mean * float(end));
  const glm::vec3 scattered = beam.flux * (1.0f - pass) * albedo;
  glm::vec3 leaving, staying;
  for (int c = 0; c < 3; ++c) {
    const Diffusion& diffusion = body().system.medium().channel[c];
    const double a = double(sigma_[c] / cosine);
    leaving[c] = beam.flux[c] * albedo[c] * float(diffusion.beamLeaving(a, end, depth));
    staying[c] = beam.flux[c] * albedo[c] * float(diffusion.beamStaying(a, end, depth));
  }
  tally_.absorbed += Rgb(beam.flux * (1.0f - pass) - scattered);
  tally_.absorbed += Rgb(scattered - leaving - staying);
  leave(sample.node, Tracer::Record::kLayer, leaving);
  deposit(sample.cell, staying);
  beam.flux *= pass;
  beam.position += way * beam.direction;
  depth_ += way * descent_;
  length -= way;
}

/// `length` through the cells, in pieces that end at the voxels' sides.
void Beamer::march(Beam& beam, float length) {
  const Grid& grid = body().shape->grid;
  const auto h = float(grid.side());
  while (length > 0 && largest(beam.flux) > 0) {
    const glm::vec3 at = grid.voxels(beam.position);
    float step = length;
    for (int axis = 0; axis < 3; ++axis) {
      const float d = beam.direction[axis];
      if (std::abs(d) < 1e-6f) continue;
      const float side = d > 0 ? std::floor(at[axis] + 1e-3f) + 1 : std::ceil(at[axis] - 1e-3f) - 1;
      step = std::fmin(step, h * (side - at[axis]) / d);
    }
    if (step > kLongest * h && !(grid.clear(beam.position + 0.5f * step * beam.direction) > 0)) step *= 0.5f;
    const glm::vec3 pass = glm::exp(-sigma_ * step);
    depth_ += 0.5f * step * descent_;
    collide(beam.position + 0.5f * step * beam.direction, beam.flux * (1.0f - pass));
    beam.flux *= pass;
    beam.position += step * beam.direction;
    depth_ += 0.5f * step * descent_;
    length -= step;
  }
}

/// Light that collides at a point becomes a source, through the exit layer if it is near a surface.
void Beamer::collide(const glm::vec3& p, const glm::vec3& flux) {
  const Surface& surface = body().shape->surface;
  const glm::vec3 scattered = flux * albedoAt(glm::vec3(depth_));
  tally_.absorbed += Rgb(flux - scattered);
  const auto place = surface.place(p);
  if (place.cell == Grid::kNone) {
    tally_.lost += Rgb(scattered);
    return;
  }
  if (place.sample == Grid::kNone) return deposit(place.cell, scattered);
  const auto& sample = surface.samples()[place.sample];
  glm::vec3 leaving, staying;
  for (int c = 0; c < 3; ++c) {
    const Diffusion& diffusion = body().system.medium().channel[c];
    leaving[c] = scattered[c] * float(diffusion.leaving(double(place.depth), double(sample.depth)));
    staying[c] = scattered[c] * float(diffusion.staying(double(place.depth), double(sample.depth)));
  }
  tally_.absorbed += Rgb(scattered - leaving - staying);
  leave(sample.node, Tracer::Record::kLayer, leaving);
  deposit(place.cell, staying);
}

void Beamer::deposit(uint32_t cell, const glm::vec3& flux) {
  tally_.source += Rgb(flux);
  if (!records_.empty() && records_.back().kind == Tracer::Record::kSource && records_.back().index == cell &&
      records_.back().object == object_) {
    records_.back().flux += flux;
    return;
  }
  records_.push_back({cell, uint16_t(object_), Tracer::Record::kSource, flux});
}

void Beamer::leave(uint32_t node, Tracer::Record::Kind kind, const glm::vec3& flux) {
  if (!(largest(flux) > 0)) return;
  if (kind == Tracer::Record::kLayer) tally_.left += Rgb(flux);
  records_.push_back({node, uint16_t(object_), kind, flux});
}

/// At a surface; false when the beam ends there.
bool Beamer::meet(Beam& beam, const RayHit& hit, glm::vec3& onwards) {
  if (hit.object != object_) {
    tally_.lost += Rgb(beam.flux);
    beam.flux = glm::vec3(0);
    return false;
  }
  const float cosI = glm::dot(onwards, hit.normal);
  if (cosI <= 0 || shells_ > 1) {
    shells_ += cosI > 0 ? -1 : 1;
    return true;
  }
  const float R = transport::fresnel(std::fmin(cosI, 1.0f), 1 / body().medium.eta).reflectance;
  tally_.unscattered += Rgb(beam.flux * (1 - R));
  beam.flux *= R;
  depth_ = descent_ > 0 ? thickness_ : 0;
  descent_ = -descent_;
  onwards = transport::mirrored(onwards, hit.normal);
  if (largest(beam.flux) > kLeastMirrored * entered_) return true;
  tally_.unscattered += Rgb(beam.flux);
  beam.flux = glm::vec3(0);
  return false;
}

/// What leaves straight from the first collision, in the medium as it is: one collision drawn for each
/// channel, that serves all by the balance heuristic, and one direction from it.
void Beamer::look(const RayHit& from, const glm::vec3& direction, float flux, float distance, size_t number) {
  const glm::vec3 colliding = 1.0f - glm::exp(-body().medium.sigma_t * distance);
  for (int channel = 0; channel < 3; ++channel)
    if (colliding[channel] > kLeastColliding)
      lookFrom(from, direction, flux, colliding, channel, double(3 * number + size_t(channel)) + 0.5);
}

void Beamer::lookFrom(const RayHit& from, const glm::vec3& direction, float flux, const glm::vec3& colliding,
                      int channel, double number) {
  const Medium& medium = body().medium;
  const float u = turn(number * kStep[0]) * colliding[channel];
  const float s = -std::log1p(-u) / medium.sigma_t[channel];
  const glm::vec3 passed = glm::exp(-medium.sigma_t * s);
  float density = 0;
  for (int c = 0; c < 3; ++c)
    if (colliding[c] > kLeastColliding) density += medium.sigma_t[c] * passed[c] / colliding[c];
  const glm::vec3 away =
      transport::deflected(direction, transport::henyeyGreensteinCosine(turn(number * kStep[1]), medium.g),
                           2 * transport::kPi * turn(number * kStep[2]));
  tally_.rays += 1;
  const RayHit hit = world_.rays->nearestInside(object_, from.position + s * direction, away);
  if (!hit || hit.object != object_) return;
  const float cosI = glm::dot(away, hit.normal);
  if (cosI <= 0) return;
  const float T = 1 - transport::fresnel(std::fmin(cosI, 1.0f), 1 / medium.eta).reflectance;
  const Surface& surface = body().shape->surface;
  const uint32_t node = surface.samples()[surface.sampleAt(hit.triangle, hit.u, hit.v)].node;
  leave(node, Tracer::Record::kFirst,
        flux * medium.sigma_s * passed / density * glm::exp(-medium.sigma_t * hit.distance) * T);
}

/// Whether nodes that follow each other can share a beam.
bool alike(const Surface::Node& a, const Surface::Node& b) {
  return a.cell == b.cell && glm::dot(a.normal, b.normal) > kAlike;
}

}  // namespace

Beamed beamLight(const World& world, const RayLight& light, const std::vector<Entering>& entering) {
  Beamed result;
  for (const auto& body : world.bodies) result.deposits.push_back(body ? Deposits(*body) : Deposits());
  for (size_t object = 0; object < world.bodies.size(); ++object) {
    if (!world.bodies[object]) continue;
    const Body& body = *world.bodies[object];
    const Entering& in = entering[object];
    const size_t blocks = (in.flux.size() + kBlock - 1) / kBlock;
    std::vector<std::vector<Tracer::Record>> records(blocks);
    std::vector<Tally> tallies(blocks);
    const auto& nodes = body.shape->surface.nodes();
    // Where a beam goes through many cells, few beams will do.
    const float perCell = least(body.reduced.sigma_t) * body.size * float(body.shape->grid.side());
    const size_t most = perCell < kSeenThrough ? kTogether : 1;
    tbb::parallel_for(size_t(0), blocks, [&](size_t b) {
      Beamer beamer(world, records[b]);
      const size_t end = std::min(in.flux.size(), (b + 1) * kBlock);
      float flux = 0;
      size_t together = 0, beams = 0;
      for (size_t i = b * kBlock; i < end; ++i) {
        if (!(in.flux[i] > 0)) continue;
        flux += in.flux[i];
        if (++together < most && i + 1 < end && in.flux[i + 1] > 0 && alike(nodes[i], nodes[i + 1])) continue;
        // Each of them in turn stands for all, so that no side of the voxels is preferred.
        const size_t n = i - beams++ % together;
        const RayHit from = middleOf(world, object, in.brightest[n]);
        const glm::vec3 arriving = -glm::vec3(light.seenFrom(from.position).direction);
        const float cosI = std::fmin(1.0f, -glm::dot(arriving, from.normal));
        const float cosT = transport::fresnel(cosI, body.medium.eta).cosT;
        beamer.follow(from, body.shape->surface.samples()[in.brightest[n]],
                      transport::refracted(arriving, from.normal, body.medium.eta, cosI, cosT), flux, n,
                      together);
        flux = 0;
        together = 0;
      }
      tallies[b] = beamer.tally();
    });
    for (size_t b = 0; b < blocks; ++b) {
      collect(records[b], result.deposits);
      result.tally += tallies[b];
    }
  }
  return result;
}

}  // namespace lychnite::volume
