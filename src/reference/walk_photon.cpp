#include "reference/walk_photon.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace lychnite {

namespace {

constexpr float kRouletteBelow = 0.05f;  // of the flux a photon starts with
constexpr float kGoldenAngle = 2.39996323f;

}  // namespace

WalkTally& WalkTally::operator+=(const WalkTally& other) {
  photons += other.photons;
  arrived += other.arrived;
  escaped += other.escaped;
  absorbed += other.absorbed;
  blocked += other.blocked;
  lost += other.lost;
  rays += other.rays;
  collisions += other.collisions;
  fans += other.fans;
  return *this;
}

void WalkPhotons::fly(double u, int channel) {
  tally_.photons += 1;
  const WalkEmission::Start start = world_.emission->start(u, rng_);
  tally_.rays += 1;
  if (!(start.flux.x + start.flux.y + start.flux.z > 0)) return;
  if (world_.rays->occluded(offPoint(start.hit, start.toLight), start.toLight, start.lightDistance)) return;
  weight_ = transport::PathWeight(start.flux, channel);
  rouletteBelow_ = kRouletteBelow * weight_.largest();
  tally_.arrived += Rgb(start.flux);
  direction_ = -start.toLight;
  object_ = -1;
  order_ = 0;
  alive_ = true;
  arrive(start.hit);
  while (alive_) object_ < 0 ? stepOutside() : stepInside();
}

/// From outside onto a translucent surface: mirrored or refracted, by Fresnel.
void WalkPhotons::arrive(const RayHit& hit) {
  const float cosI = -glm::dot(direction_, hit.normal), eta = world_.media[size_t(hit.object)].eta;
  const transport::Boundary boundary = transport::fresnel(cosI, eta);
  if (rng_.uniform() < boundary.reflectance) {
    direction_ = transport::mirrored(direction_, hit.normal);
  } else {
    direction_ = transport::refracted(direction_, hit.normal, eta, cosI, boundary.cosT);
    object_ = hit.object;
    shells_ = 1;
    ahead_ = -1;
    straight_ = false;
  }
  position_ = offPoint(hit, direction_);
}

void WalkPhotons::stepOutside() {
  tally_.rays += 1;
  const RayHit hit = world_.rays->nearest(position_, direction_);
  if (!hit) {
    tally_.escaped += Rgb(weight_.flux());
    alive_ = false;
  } else if (world_.rays->opaque(hit.object)) {
    tally_.blocked += Rgb(weight_.flux());
    alive_ = false;
  } else if (glm::dot(direction_, hit.normal) < 0) {
    arrive(hit);
  } else if (world_.closed[size_t(hit.object)]) {
    // Met from behind: the photon left one object inside another that overlaps it. It goes on in the other's
    // medium.
    object_ = hit.object;
    shells_ = 1;
    ahead_ = -1;
    straight_ = false;
  } else {
    lose();
  }
}

void WalkPhotons::stepInside() {
  const float flight = weight_.drawFlight(medium(), rng_);
  RayHit hit;
  if (ahead_ >= 0) {
    hit = fan_.hit[size_t(ahead_)];
    ahead_ = -1;
  } else if (flight < world_.distance[size_t(object_)]->at(position_)) {
    collide(flight);
    return;
  } else {
    // In an open mesh only a ray to the end tells a wall from a hole.
    const bool closed = world_.closed[size_t(object_)];
    tally_.rays += 1;
    hit = world_.rays->nearestInside(object_, position_, direction_,
                                     closed ? flight : std::numeric_limits<float>::infinity());
    if (!hit && (!closed || std::isinf(flight))) return lose();
  }
  if (hit && hit.distance <= flight)
    meet(hit);
  else if (std::isinf(flight))
    lose();
  else
    collide(flight);
}

void WalkPhotons::collide(float distance) {
  tally_.collisions += 1;
  position_ += distance * direction_;
  if (!world_.distance[size_t(object_)]->contains(position_)) return lose();
  tally_.absorbed += Rgb(weight_.scatter(medium(), distance));
  ++order_;
  alive_ = weight_.survives(rouletteBelow_, rng_);
  if (!alive_) return;
  straight_ = true;
  if (order_ >= firstOrder())
    openFan();
  else
    direction_ = transport::scattered(direction_, medium().g, rng_);
}

void WalkPhotons::openFan() {
  const float relative = weight_.largest() * kRouletteBelow / rouletteBelow_;
  const float chance = film_ || learn_ ? guide_.chance(position_, relative) : 0;
  if (rng_.uniform() >= chance) {
    direction_ = transport::scattered(direction_, medium().g, rng_);
    return;
  }
  tally_.fans += 1;
  fan_.count = RayFan::kMost;
  const float phi = 2 * transport::kPi * rng_.uniform(), g = medium().g;
  for (int i = 0; i < fan_.count; ++i) {
    const float cosine =
        transport::henyeyGreensteinCosine((float(i) + rng_.uniform()) / float(fan_.count), g);
    fan_.direction[size_t(i)] = transport::deflected(direction_, cosine, phi + kGoldenAngle * float(i));
  }
  traceInside(*world_.rays, object_, position_, fan_);
  const float square = splatFan(chance);
  if (learn_) learn_->add(position_, square / (relative * relative), chance);
  ahead_ = int(rng_.below(uint32_t(fan_.count)));
  direction_ = fan_.direction[size_t(ahead_)];
}

/// Splats the flux that leaves along each ray of the fan; returns the sum of the splats squared.
float WalkPhotons::splatFan(float chance) {
  if (shells_ != 1) return 0;
  SightFan sight;
  std::array<int, RayFan::kMost> ray;
  std::array<WalkLens::Seen, RayFan::kMost> seen;
  for (int i = 0; i < fan_.count; ++i) {
    const RayHit& hit = fan_.hit[size_t(i)];
    if (hit.object != object_ || glm::dot(fan_.direction[size_t(i)], hit.normal) <= 0) continue;
    const WalkLens::Seen s = world_.lens->see(hit.position);
    if (s.pixel < 0 || glm::dot(s.direction, hit.normal) <= 0) continue;
    const auto n = size_t(sight.count++);
    ray[n] = i;
    seen[n] = s;
    sight.from[n] = offPoint(hit, s.direction);
    sight.direction[n] = s.direction;
    sight.distance[n] = s.distance;
  }
  traceSight(*world_.rays, sight);
  float squares = 0;
  for (size_t n = 0; n < size_t(sight.count); ++n) {
    if (sight.blocked[n]) continue;
    const RayHit& hit = fan_.hit[size_t(ray[n])];
    const float cosI = glm::dot(fan_.direction[size_t(ray[n])], hit.normal);
    const float T = 1 - transport::fresnel(std::fmin(cosI, 1.0f), 1 / medium().eta).reflectance;
    if (T <= 0) continue;
    const glm::vec3 flux = weight_.passing(medium(), hit.distance) * (T / float(fan_.count));
    const float value = splat(hit, seen[n], flux / chance) * chance;
    squares += value * value;
  }
  return squares;
}

/// Adds a flux that leaves at a visible point; returns the radiance it added (mean of RGB).
float WalkPhotons::splat(const RayHit& hit, const WalkLens::Seen& seen, const glm::vec3& flux) {
  const float cosine = glm::dot(seen.direction, hit.normal);
  const glm::vec3 radiosity = flux * (cosine * seen.importance);
  // The shape follows the interpolated normal, so that facets do not show; the measure above is the facet's.
  const float cosO = glm::dot(world_.rays->mesh(hit.object).shadingNormal(hit), seen.direction);
  const float T =
      cosO > 0
          ? 1 - transport::fresnel(std::fmin(cosO, 1.0f), world_.media[size_t(hit.object)].eta).reflectance
          : 0;
  const glm::vec3 radiance = radiosity * (T * world_.lobeScale[size_t(hit.object)]);
  if (film_) {
    if (order_ >= 2) film_->add(seen.pixel, 0, radiance);
    if (world_.radiosity) film_->add(seen.pixel, 1, radiosity);
  }
  return (radiance.x + radiance.y + radiance.z) / 3;
}

void WalkPhotons::splatIfSeen(const RayHit& hit, const glm::vec3& flux) {
  if (!film_) return;
  const WalkLens::Seen seen = world_.lens->see(hit.position);
  if (seen.pixel < 0 || glm::dot(seen.direction, hit.normal) <= 0) return;
  tally_.rays += 1;
  if (world_.rays->occluded(offPoint(hit, seen.direction), seen.direction, seen.distance)) return;
  splat(hit, seen, flux);
}

void WalkPhotons::meet(const RayHit& hit) {
  if (world_.rays->opaque(hit.object)) {
    weight_.pass(medium(), hit.distance);
    tally_.blocked += Rgb(weight_.flux());
    alive_ = false;
    return;
  }
  const float cosI = glm::dot(direction_, hit.normal);
  if (cosI <= 0 && !world_.closed[size_t(object_)]) return lose();
  weight_.pass(medium(), hit.distance);
  if (cosI > 0 && shells_ == 1) return leave(hit, std::fmin(cosI, 1.0f));
  // A shell of the same object inside this one: still its medium.
  shells_ += cosI > 0 ? -1 : 1;
  straight_ = false;
  position_ = offPoint(hit, direction_);
}

/// From inside onto the surface: mirrored back, or out.
void WalkPhotons::leave(const RayHit& hit, float cosI) {
  const float eta = 1 / medium().eta;
  const transport::Boundary boundary = transport::fresnel(cosI, eta);
  const float T = 1 - boundary.reflectance;
  if (!straight_ && T > 0 && order_ >= firstOrder()) splatIfSeen(hit, weight_.flux() * T);
  straight_ = false;
  if (rng_.uniform() < boundary.reflectance) {
    direction_ = transport::mirrored(direction_, hit.normal);
  } else {
    direction_ = transport::refracted(direction_, -hit.normal, eta, cosI, boundary.cosT);
    object_ = -1;
  }
  position_ = offPoint(hit, direction_);
}

}  // namespace lychnite
