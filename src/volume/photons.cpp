#include "volume/photons.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace lychnite::volume {

namespace {

using transport::Medium;
using transport::Rng;

constexpr int kMostMirrorings = 64;  // of one flight inside
constexpr int kMostBranches = 8;     // of a photon outside
constexpr float kClearPays = 0.5f;   // a clear way longer than this many mean free paths needs no ray
constexpr float kDeep = 4;           // reduced mean free paths to a surface, at least
constexpr float kMostLonger = 4;     // times as many collisions where g is near 1
constexpr float kNegligible = 16;    // mean free paths that nothing passes
constexpr float kBelowOne = 0.99999994f;
constexpr float kBranchChance = 4;  // of light that leaves unscattered, per share of the photon
constexpr float kReturnChance = 1;  // of light that leaves scattered, to be followed

float least(const glm::vec3& v) {
  return std::fmin(v.x, std::fmin(v.y, v.z));
}
float largest(const glm::vec3& v) {
  return std::fmax(v.x, std::fmax(v.y, v.z));
}
Lanes lanes(const glm::vec3& v) {
  return Lanes{v.x, v.y, v.z, 0};
}
glm::vec3 passing(const Medium& medium, float distance) {
  return glm::exp(-medium.sigma_t * distance);
}

/// Keeps the mean density 1.
void normalise(Photon& photon) {
  const float sum = photon.density.x + photon.density.y + photon.density.z;
  if (!(sum > 0)) {
    photon.flux = glm::vec3(0);
    return;
  }
  photon.flux *= 3 / sum;
  photon.density *= 3 / sum;
}

}  // namespace

Deposits::Deposits(const Body& body)
    : first(body.shape->surface.nodes().size(), Lanes{0, 0, 0, 0}),
      later(first),
      layer(first),
      source(body.shape->grid.size(), Lanes{0, 0, 0, 0}) {}

Deposits& Deposits::operator+=(const Deposits& other) {
  for (size_t i = 0; i < first.size(); ++i) {
    first[i] += other.first[i];
    later[i] += other.later[i];
    layer[i] += other.layer[i];
  }
  for (size_t i = 0; i < source.size(); ++i) source[i] += other.source[i];
  return *this;
}

void Deposits::scale(float factor) {
  for (auto* part : {&first, &later, &layer, &source})
    for (Lanes& l : *part) l *= factor;
}

Tally& Tally::operator+=(const Tally& other) {
  arrived += other.arrived;
  entered += other.entered;
  unscattered += other.unscattered;
  left += other.left;
  absorbed += other.absorbed;
  source += other.source;
  lost += other.lost;
  flights += other.flights;
  rays += other.rays;
  return *this;
}

void Tracer::arrive(const RayHit& hit, const glm::vec3& direction, const glm::vec3& flux, float drawn,
                    const glm::vec3& u, Rng rng, int order, int collisions) {
  rng_ = rng;
  Photon photon;
  photon.direction = direction;
  photon.flux = flux;
  photon.arrived = largest(flux);
  if (const auto& in = world_.bodies[size_t(hit.object)]) {
    photon.channel = drawn < in->chances.x ? 0 : drawn < in->chances.x + in->chances.y ? 1 : 2;
    photon.density = 3.0f * in->chances;
  }
  photon.order = order;
  photon.collisions = collisions;
  firstNumbers_ = u;
  tally_.arrived += Rgb(flux);
  enter(photon, hit);
  while (!waiting_.empty()) {
    const Photon next = waiting_.back();
    waiting_.pop_back();
    outside(next);
  }
}

/// From outside onto a surface: what is mirrored goes on by chance, the rest goes in.
void Tracer::enter(Photon photon, const RayHit& hit) {
  if (!world_.bodies[size_t(hit.object)]) {
    tally_.lost += Rgb(photon.flux);
    return;
  }
  const float cosI = std::fmin(1.0f, -glm::dot(photon.direction, hit.normal));
  const float eta = world_.bodies[size_t(hit.object)]->medium.eta;
  const transport::Boundary boundary = transport::fresnel(cosI, eta);
  if (photon.branch < kMostBranches && rng_.uniform() < boundary.reflectance) {
    Photon mirrored = photon;
    mirrored.direction = transport::mirrored(photon.direction, hit.normal);
    mirrored.position = offPoint(hit, mirrored.direction);
    ++mirrored.branch;
    waiting_.push_back(mirrored);
  }
  photon.flux *= 1 - boundary.reflectance;
  photon.direction = transport::refracted(photon.direction, hit.normal, eta, cosI, boundary.cosT);
  photon.position = offPoint(hit, photon.direction);
  photon.object = hit.object;
  photon.descent = boundary.cosT;
  photon.thickness = std::numeric_limits<float>::infinity();
  shells_ = 1;
  tally_.entered += Rgb(photon.flux);
  fly(photon);
}

void Tracer::outside(Photon photon) {
  tally_.rays += 1;
  const RayHit hit = world_.rays->nearest(photon.position, photon.direction);
  if (!hit || world_.rays->opaque(hit.object) || glm::dot(hit.normal, photon.direction) >= 0) return;
  firstNumbers_ = glm::vec3(rng_.uniform(), rng_.uniform(), rng_.uniform());
  enter(photon, hit);
}

/// So far from any surface that diffusion describes all that comes.
bool Tracer::deep(const Photon& photon) const {
  return photon.order > 0 &&
         body(photon).clear(photon.position) * least(body(photon).reduced.sigma_t) > kDeep;
}

/// Inside, from collision to collision, until the last.
void Tracer::fly(Photon photon) {
  const Body& in = body(photon);
  glm::vec3 u = firstNumbers_;
  // Where scattering goes forwards it takes more collisions to come as near to diffusion.
  const float longer = std::clamp(1 / (1 - in.medium.g), 1.0f, kMostLonger);
  int left = std::max(1, int(std::lround(float(photon.collisions) * longer)));
  while (largest(photon.flux) > 0) {
    const bool last = left == 1 || deep(photon);
    // The last flight is one of the isotropic medium of equal sigma_sp: it takes up what anisotropy is left.
    const Medium& medium = last ? in.reduced : in.medium;
    if (!advance(photon, medium, u.x)) return;
    ++photon.order;
    --left;
    if (last) return handOver(photon);
    photon.direction = transport::deflected(
        photon.direction, transport::henyeyGreensteinCosine(u.y, medium.g), 2 * transport::kPi * u.z);
    u = glm::vec3(rng_.uniform(), rng_.uniform(), rng_.uniform());
  }
}

/// One flight to a collision, mirrored on the way as often as need be; `u` in [0, 1) draws it. False when
/// nothing is left of it.
bool Tracer::advance(Photon& photon, const Medium& medium, float u) {
  tally_.flights += 1;
  const Body& in = body(photon);
  const float sigma = medium.sigma_t[photon.channel];
  const float far = kNegligible / std::fmax(least(medium.sigma_t), 1e-6f);
  for (int mirrorings = 0; mirrorings < kMostMirrorings;) {
    const float clear = in.clear(photon.position);
    if (clear * least(medium.sigma_t) > kClearPays) {
      const float stays = -std::expm1(-sigma * clear);
      if (u < stays) return collide(photon, medium, -std::log1p(-u) / sigma, glm::vec3(1));
      u = std::fmin((u - stays) / (1 - stays), kBelowOne);
      photon.flux *= passing(medium, clear);
      photon.density *= passing(medium, clear);
      normalise(photon);
      photon.position += clear * photon.direction;
      continue;
    }
    tally_.rays += 1;
    const RayHit hit = world_.rays->nearestInside(photon.object, photon.position, photon.direction, far);
    if (hit && photon.order == 0 && mirrorings == 0)
      photon.thickness = std::fmin(photon.thickness, hit.distance * photon.descent);
    if (!hit && sigma > 0) return collide(photon, medium, -std::log1p(-u) / sigma, glm::vec3(1));
    if (!hit) break;
    ++mirrorings;
    const Outcome outcome = meet(photon, medium, hit, u);
    if (outcome != Outcome::kGoesOn) return outcome == Outcome::kCollided;
  }
  tally_.lost += Rgb(photon.flux);
  return false;
}

/// What a flight that can reach a surface does: the part that gets out is deposited, the rest collides before
/// the surface or is mirrored by it, drawn by `u`, which is renewed for the way on.
Tracer::Outcome Tracer::meet(Photon& photon, const Medium& medium, const RayHit& hit, float& u) {
  const glm::vec3 pass = passing(medium, hit.distance);
  const float cosI = glm::dot(photon.direction, hit.normal);
  float R = 0;
  bool through = false;
  if (hit.object != photon.object) {
    tally_.lost += Rgb(photon.flux * pass);
  } else if (cosI <= 0 || shells_ > 1) {
    // A shell of the same object inside another: still its medium.
    shells_ += cosI > 0 ? -1 : 1;
    through = true;
    R = 1;
  } else {
    const transport::Boundary boundary = transport::fresnel(std::fmin(cosI, 1.0f), 1 / medium.eta);
    R = boundary.reflectance;
    if (R < 1) leave(photon, hit, photon.flux * pass * (1 - R), largest(pass) * (1 - R));
  }
  const glm::vec3 total = glm::max(1.0f - pass * (1 - R), glm::vec3(1e-20f));
  const float drawn = total[photon.channel], collides = 1 - pass[photon.channel];
  if (!(drawn > 1e-20f)) return Outcome::kGone;
  if (u * drawn < collides) {
    collide(photon, medium, -std::log1p(-u * drawn) / medium.sigma_t[photon.channel], total);
    return Outcome::kCollided;
  }
  u = std::fmin((u * drawn - collides) / (drawn - collides), kBelowOne);
  photon.flux *= pass * R;
  photon.density *= pass * R / total;
  normalise(photon);
  if (!through) photon.direction = transport::mirrored(photon.direction, hit.normal);
  photon.position = offPoint(hit, photon.direction);
  return largest(photon.flux) > 0 ? Outcome::kGoesOn : Outcome::kGone;
}

/// `total` is the share of each channel's flights that were not let out. Always true.
bool Tracer::collide(Photon& photon, const Medium& medium, float distance, const glm::vec3& total) {
  const glm::vec3 relative = glm::exp((medium.sigma_t[photon.channel] - medium.sigma_t) * distance);
  const glm::vec3 colliding = photon.flux * relative;
  photon.density *= relative * medium.sigma_t / total;
  photon.flux = colliding * medium.sigma_t;
  normalise(photon);
  photon.position += distance * photon.direction;
  for (int c = 0; c < 3; ++c) {
    const float scatters = medium.sigma_t[c] > 0 ? medium.sigma_s[c] / medium.sigma_t[c] : 0;
    tally_.absorbed[c] += double(photon.flux[c] * (1 - scatters));
    photon.flux[c] *= scatters;
  }
  return true;
}

/// Light that gets out at `hit`. `share` is the most that it is of the photon, over the channels.
void Tracer::leave(const Photon& photon, const RayHit& hit, const glm::vec3& flux, float share) {
  if (photon.order > 0) {
    tally_.left += Rgb(flux);
    const Surface& surface = body(photon).shape->surface;
    const uint32_t node = surface.samples()[surface.sampleAt(hit.triangle, hit.u, hit.v)].node;
    records_.push_back(
        {node, uint16_t(photon.object), photon.order == 1 ? Record::kFirst : Record::kLater, flux});
    if (!world_.returns) return;
  } else {
    tally_.unscattered += Rgb(flux);
  }
  // So that what is followed weighs as much as the photon did at first.
  const float chance = std::fmin(
      1.0f, photon.order > 0 ? kReturnChance * largest(flux) / photon.arrived : kBranchChance * share);
  if (photon.branch >= kMostBranches || rng_.uniform() >= chance) return;
  const float cosI = std::fmin(1.0f, glm::dot(photon.direction, hit.normal)),
              eta = 1 / body(photon).medium.eta;
  Photon out = photon;
  out.flux = flux / chance;
  out.direction =
      transport::refracted(photon.direction, -hit.normal, eta, cosI, transport::fresnel(cosI, eta).cosT);
  out.position = offPoint(hit, out.direction);
  if (out.order > 0) out.order = std::max(out.order, 2);  // where it enters again it is not the first
  ++out.branch;
  waiting_.push_back(out);
}

/// How much of a source the diffusion equation needs for as much light to leave as transport says.
glm::vec3 Tracer::strength(const Photon& photon, const Surface::Place& place) const {
  const Body& in = body(photon);
  const float depth = place.sample != Grid::kNone
                          ? place.depth * in.size
                          : in.clear(photon.position) + float(in.shape->grid.side()) * in.size;
  const float thickness = std::fmin(photon.thickness, in.thickness * in.size);
  glm::vec3 result(1);
  for (int c = 0; c < 3; ++c)
    result[c] += in.slabs[c].excess(in.reduced.sigma_t[c] * thickness, in.reduced.sigma_t[c] * depth);
  return result;
}

/// After the last collision: a part leaves through the layer above the cell's centroid at once, a part is
/// absorbed in it, the rest is a source of the cell.
void Tracer::handOver(const Photon& photon) {
  const Body& in = body(photon);
  const Surface& surface = in.shape->surface;
  const auto place = surface.place(in.toLocal(photon.position));
  if (place.cell == Grid::kNone) {
    tally_.lost += Rgb(photon.flux);
    return;
  }
  const glm::vec3 source = photon.flux * strength(photon, place);
  glm::vec3 leaving(0), staying = source;
  if (place.sample != Grid::kNone) {
    const double depth = double(surface.samples()[place.sample].depth), z = double(place.depth);
    for (int c = 0; c < 3; ++c) {
      const Diffusion& diffusion = in.system.medium().channel[c];
      leaving[c] = source[c] * float(diffusion.leaving(z, depth));
      staying[c] = source[c] * float(diffusion.staying(z, depth));
    }
    if (largest(leaving) > 0)
      records_.push_back(
          {surface.samples()[place.sample].node, uint16_t(photon.object), Record::kLayer, leaving});
  }
  tally_.left += Rgb(leaving);
  tally_.absorbed += Rgb(photon.flux - leaving - staying);
  tally_.source += Rgb(staying);
  records_.push_back({place.cell, uint16_t(photon.object), Record::kSource, staying});
  if (photon.order == 1) separateFirst(photon);
}

/// When nothing is followed past the first collision, what leaves straight from it is told apart from the
/// rest by one more look.
void Tracer::separateFirst(const Photon& photon) {
  const Body& in = body(photon);
  const glm::vec3 direction =
      transport::deflected(photon.direction, 1 - 2 * rng_.uniform(), 2 * transport::kPi * rng_.uniform());
  tally_.rays += 1;
  const RayHit hit = world_.rays->nearestInside(photon.object, photon.position, direction);
  if (!hit || hit.object != photon.object) return;
  const float cosI = glm::dot(direction, hit.normal);
  if (cosI <= 0) return;
  const float T = 1 - transport::fresnel(std::fmin(cosI, 1.0f), 1 / in.medium.eta).reflectance;
  const glm::vec3 flux = photon.flux * passing(in.reduced, hit.distance) * T;
  if (!(largest(flux) > 0)) return;
  const Surface& surface = in.shape->surface;
  const uint32_t node = surface.samples()[surface.sampleAt(hit.triangle, hit.u, hit.v)].node;
  records_.push_back({node, uint16_t(photon.object), Record::kFirst, flux});
  records_.push_back({node, uint16_t(photon.object), Record::kLater, -flux});
}

void collect(const std::vector<Tracer::Record>& records, std::vector<Deposits>& deposits) {
  for (const Tracer::Record& r : records) {
    Deposits& to = deposits[r.object];
    (r.kind == Tracer::Record::kSource  ? to.source
     : r.kind == Tracer::Record::kLayer ? to.layer
     : r.kind == Tracer::Record::kFirst ? to.first
                                        : to.later)[r.index] += lanes(r.flux);
  }
}

}  // namespace lychnite::volume
