#include "reference/walk_photon.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lychnite {

namespace {

constexpr float kRouletteBelow = 0.05f;  // of what a photon carries on average
constexpr float kStartCost = 0.2f;       // of a photon before its first step, in fans
constexpr float kGoldenAngle = 2.39996323f;
constexpr int kFollowed = 2;        // mirrorings inside that a fan's rays go through
constexpr float kFollowChance = 2;  // of a ray that carries all of the photon's flux
constexpr int kUnaccounted = 1000;  // mirrorings of a photon whose exit no fan stands for
constexpr float kDeepestCell = 4;   // in mean free paths, of a cell that tells how heavy photons should be
constexpr int kMostParts = 8;       // of one splitting
constexpr float kTooLight = 0.4f;   // of the ideal weight: ended by chance below
constexpr int kByPhase =
    2;  // rays of a fan that follow the phase function, where the guide knows better ones

// Measured costs of a ray and a collision over that of a fan (two-core Xeon, 70 k triangles).
constexpr double kRayPerFan = 0.13, kCollisionPerFan = 0.03;

}  // namespace

double WalkTally::cost() const {
  return rays * kRayPerFan + collisions * kCollisionPerFan + fans;
}

WalkTally& WalkTally::operator+=(const WalkTally& other) {
  photons += other.photons;
  arrived += other.arrived;
  escaped += other.escaped;
  absorbed += other.absorbed;
  blocked += other.blocked;
  lost += other.lost;
  ended += other.ended;
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
  tally_.arrived += Rgb(start.flux);
  direction_ = -start.toLight;
  object_ = -1;
  order_ = 0;
  alive_ = true;
  const double costBefore = tally_.cost();
  splats_.clear();
  sources_ = 0;
  arrive(start.hit);
  passed_.clear();
  squares_ = 0;
  startCost_ = costBefore;
  for (;;) {
    while (alive_) object_ < 0 ? stepOutside() : stepInside();
    if (twins_.empty()) break;
    takeTwin();
  }
  if (learn_) {
    learnPhoton(start, float(tally_.cost() - costBefore));
    learnPassed(float(tally_.cost() - costBefore));
  }
}

void WalkPhotons::learnPassed(float cost) {
  for (const Passed& p : passed_) {
    auto& cell = learn_->passing[WalkGuideSamples::cellOf(p.position)];
    cell.count += 1;
    cell.squares += (squares_ - p.squares) / (p.weight * p.weight);
    cell.cost += cost - p.cost;
  }
}

bool WalkPhotons::survives(float threshold) {
  const glm::vec3 before = weight_.flux();
  const bool goesOn = weight_.survives(threshold, rng_);
  tally_.ended += Rgb(before) - (goesOn ? Rgb(weight_.flux()) : Rgb(0));
  return goesOn;
}

/// Splits a photon that is heavier than it should be here, or ends a light one by chance; returns whether it
/// goes on.
bool WalkPhotons::splitOrEnd() {
  // Where a cell of the guide holds the skin and the dark below it, one weight for all of it would do harm.
  const float depth = std::fmax(medium().sigma_t.x, std::fmax(medium().sigma_t.y, medium().sigma_t.z)) *
                      (1 - medium().g) * WalkGuideSamples::kCellSize;
  const float ideal = depth < kDeepestCell ? guide_.idealWeight(position_) * world_.fluxUnit : 0;
  if (!(ideal > 0)) return survives(kRouletteBelow * world_.fluxUnit);
  const float heavy = weight_.largest() / ideal;
  if (heavy > 2) {
    const int parts = std::min(int(heavy + rng_.uniform()), kMostParts);
    weight_.scale(1 / float(parts));
    for (int i = 1; i < parts; ++i)
      twins_.push_back({weight_, position_, direction_, object_, shells_, order_});
    return true;
  }
  return survives(kTooLight * ideal);
}

void WalkPhotons::takeTwin() {
  const Twin& twin = twins_.back();
  weight_ = twin.weight;
  position_ = twin.position;
  direction_ = twin.direction;
  object_ = twin.object;
  shells_ = twin.shells;
  order_ = twin.order;
  twins_.pop_back();
  alive_ = true;
  ahead_ = -1;
  clear_ = -1;
  mirrorings_ = 0;
  afterCollision();
}

/// What this photon adds to the picture's variance: its splats in one pixel add up. What splats of different
/// sources have in common there, and in expectation those of one fan, more fans would not lessen.
void WalkPhotons::learnPhoton(const WalkEmission::Start& start, float cost) {
  std::sort(splats_.begin(), splats_.end(), [](const Splat& a, const Splat& b) {
    return a.pixel != b.pixel ? a.pixel < b.pixel : a.source < b.source;
  });
  double squares = 0, common = 0;
  for (size_t i = 0; i < splats_.size();) {
    double pixel = 0, apart = 0;
    const size_t first = i;
    while (i < splats_.size() && splats_[i].pixel == splats_[first].pixel) {
      double sum = 0, alone = 0;
      const Splat s = splats_[i];
      for (; i < splats_.size() && splats_[i].pixel == s.pixel && splats_[i].source == s.source; ++i) {
        sum += double(splats_[i].value);
        alone += double(splats_[i].value) * double(splats_[i].value);
      }
      pixel += sum;
      apart += sum * sum;
      constexpr double kPairs = double(RayFan::kMost) / (RayFan::kMost - 1);
      common += s.source == 0 ? sum * sum : (sum * sum - alone) * kPairs / double(s.stands);
    }
    squares += pixel * pixel;
    common += pixel * pixel - apart;
  }
  auto& cell = learn_->starts[WalkGuideSamples::cellOf(start.hit.position)];
  cell.count += 1;
  cell.squares += float(squares);
  cell.cost += cost + kStartCost;
  learn_->commonSquares += common;
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
    mirrorings_ = kUnaccounted;
  }
  position_ = offPoint(hit, direction_);
  clear_ = 0;
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
    mirrorings_ = kUnaccounted;
  } else {
    lose();
  }
}

void WalkPhotons::stepInside() {
  if (!(clear_ >= 0)) clear_ = std::fmax(0.0f, world_.distance[size_t(object_)]->at(position_));
  const float flight = weight_.drawFlight(medium(), rng_);
  RayHit hit;
  if (ahead_ >= 0) {
    hit = fan_.hit[size_t(ahead_)];
    ahead_ = -1;
  } else {
    const float clear = world_.distance[size_t(object_)]->along(position_, direction_, flight, clear_);
    if (clear >= flight) return collide(flight);
    // In an open mesh only a ray to the end tells a wall from a hole.
    const bool closed = world_.closed[size_t(object_)];
    tally_.rays += 1;
    hit = world_.rays->nearestInside(object_, position_ + clear * direction_, direction_,
                                     closed ? flight - clear : std::numeric_limits<float>::infinity());
    hit.distance += clear;
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
  clear_ = -1;
  if (!world_.distance[size_t(object_)]->contains(position_)) return lose();
  tally_.absorbed += Rgb(weight_.scatter(medium(), distance));
  ++order_;
  if (learn_ && weight_.largest() > 0)
    passed_.push_back(
        {position_, weight_.largest() / world_.fluxUnit, squares_, float(tally_.cost() - startCost_)});
  alive_ = splitOrEnd();
  if (!alive_) return;
  mirrorings_ = 0;
  afterCollision();
}

void WalkPhotons::afterCollision() {
  if (order_ >= firstOrder())
    goOn();
  else
    direction_ = transport::scattered(direction_, medium().g, rng_);
}

/// After a collision: fans as the guide says, and the direction to go on.
void WalkPhotons::goOn() {
  // Nothing leaves from here without passing the nearest surface.
  clear_ = std::fmax(0.0f, world_.distance[size_t(object_)]->at(position_));
  const float reach = weight_.largest() / world_.fluxUnit * std::exp(-leastExtinction() * clear_);
  const float expected = film_ || learn_ ? guide_.fans(position_, reach) : 0;
  const int fans = int(expected + rng_.uniform());
  if (fans == 0) {
    direction_ = transport::scattered(direction_, medium().g, rng_);
    return;
  }
  for (int i = 0; i < fans; ++i) {
    openFan();
    splatFan(expected, reach);
  }
  tally_.fans += fans;
  ahead_ = int(rng_.below(uint32_t(byPhase_)));
  direction_ = fan_.direction[size_t(ahead_)];
}

/// Traces rays in directions drawn by the phase function and by the guide's lobe, each set spread evenly.
/// Both sets together are weighted by the balance heuristic (Veach & Guibas 1995 eq. 14).
void WalkPhotons::openFan() {
  const WalkGuide::Lobe& lobe = guide_.lobe(position_);
  const float g = medium().g, phi = 2 * transport::kPi * rng_.uniform();
  fan_.count = RayFan::kMost;
  byPhase_ = lobe.kappa > 0 ? kByPhase : fan_.count;
  for (int i = 0; i < fan_.count; ++i) {
    const bool phase = i < byPhase_;
    const int of = phase ? byPhase_ : fan_.count - byPhase_;
    const float u = (float(phase ? i : i - byPhase_) + rng_.uniform()) / float(of);
    const float turn = phi + kGoldenAngle * float(i);
    fan_.direction[size_t(i)] =
        phase ? transport::deflected(direction_, transport::henyeyGreensteinCosine(u, g), turn)
              : lobe.draw(u, turn);
  }
  for (int i = 0; i < fan_.count; ++i) {
    const glm::vec3& d = fan_.direction[size_t(i)];
    const float phase = transport::henyeyGreenstein(glm::dot(direction_, d), g);
    const float other = lobe.kappa > 0 ? float(fan_.count - byPhase_) * lobe.density(d) : 0;
    fan_.from[size_t(i)] = position_;
    fan_.first[size_t(i)] = d;
    fan_.before[size_t(i)] = 0;
    fan_.weight[size_t(i)] = phase / (float(byPhase_) * phase + other);
  }
  traceInside(*world_.rays, object_, fan_);
}

/// Splats what leaves along the rays of one of `expected` fans, straight away and after up to kFollowed
/// mirrorings.
void WalkPhotons::splatFan(float expected, float reach) {
  if (learn_) {
    ++sources_;
    auto& cell = learn_->cells[WalkGuideSamples::cellOf(position_)];
    cell.count += 1 / expected;
    cell.reaches += reach / expected;
  }
  if (shells_ != 1) return;
  splatExits(fan_, expected, reach);
  RayFan mirrored;
  for (int i = 0; i < kFollowed; ++i) {
    mirrored = followed(i == 0 ? fan_ : mirrored);
    if (mirrored.count == 0) return;
    traceInside(*world_.rays, object_, mirrored);
    splatExits(mirrored, expected, reach);
  }
}

/// The rays of a fan after their mirroring at the surface; those that carry little are followed by chance.
RayFan WalkPhotons::followed(const RayFan& fan) {
  RayFan next;
  for (size_t i = 0; i < size_t(fan.count); ++i) {
    const RayHit& hit = fan.hit[i];
    const float cosI = glm::dot(fan.direction[i], hit.normal);
    if (hit.object != object_ || cosI <= 0) continue;
    const float R = transport::fresnel(std::fmin(cosI, 1.0f), 1 / medium().eta).reflectance;
    const float length = fan.before[i] + hit.distance;
    const float carried = fan.weight[i] * R * std::exp(-leastExtinction() * length);
    const float chance = std::fmin(1.0f, kFollowChance * carried);
    if (rng_.uniform() >= chance) continue;
    const auto n = size_t(next.count++);
    next.direction[n] = transport::mirrored(fan.direction[i], hit.normal);
    next.from[n] = offPoint(hit, next.direction[n]);
    next.first[n] = fan.first[i];
    next.before[n] = length;
    next.weight[n] = fan.weight[i] * R / chance;
  }
  return next;
}

void WalkPhotons::splatExits(const RayFan& fan, float expected, float reach) {
  SightFan sight;
  std::array<size_t, RayFan::kMost> ray;
  std::array<WalkLens::Seen, RayFan::kMost> seen;
  std::array<float, RayFan::kMost> leaving;
  for (size_t i = 0; i < size_t(fan.count); ++i) {
    const RayHit& hit = fan.hit[i];
    const float cosI = glm::dot(fan.direction[i], hit.normal);
    if (hit.object != object_ || cosI <= 0) continue;
    const float T = 1 - transport::fresnel(std::fmin(cosI, 1.0f), 1 / medium().eta).reflectance;
    if (T <= 0) continue;
    const WalkLens::Seen s = world_.lens->see(hit.position);
    if (s.pixel < 0 || glm::dot(s.direction, hit.normal) <= 0) continue;
    const auto n = size_t(sight.count++);
    ray[n] = i;
    seen[n] = s;
    leaving[n] = T * fan.weight[i];
    sight.from[n] = offPoint(hit, s.direction);
    sight.direction[n] = s.direction;
    sight.distance[n] = s.distance;
  }
  traceSight(*world_.rays, sight);
  const float each = 1 / expected;
  for (size_t n = 0; n < size_t(sight.count); ++n) {
    if (sight.blocked[n]) continue;
    const RayHit& hit = fan.hit[ray[n]];
    const glm::vec3 flux = weight_.passing(medium(), fan.before[ray[n]] + hit.distance) * leaving[n];
    const float value = splat(hit, seen[n], flux * each);
    if (learn_) learnSplat(seen[n].pixel, fan.first[ray[n]], value, each, reach);
  }
}

/// `value` is what was splatted: 1 / expected, `each`, of what the fan's ray stands for.
void WalkPhotons::learnSplat(int64_t pixel, const glm::vec3& direction, float value, float each,
                             float reach) {
  splats_.push_back({pixel, sources_, value, each});
  squares_ += value * value;
  auto& cell = learn_->cells[WalkGuideSamples::cellOf(position_)];
  cell.squares += value * value / (reach * reach * each);
  cell.light += value;
  cell.splats += 1;
  cell.towards += direction * value;
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
  if (!film_ && !learn_) return;
  const WalkLens::Seen seen = world_.lens->see(hit.position);
  if (seen.pixel < 0 || glm::dot(seen.direction, hit.normal) <= 0) return;
  tally_.rays += 1;
  if (world_.rays->occluded(offPoint(hit, seen.direction), seen.direction, seen.distance)) return;
  const float value = splat(hit, seen, flux);
  if (!learn_) return;
  splats_.push_back({seen.pixel, 0, value, 1});
  squares_ += value * value;
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
  mirrorings_ = kUnaccounted;
  position_ = offPoint(hit, direction_);
  clear_ = 0;
}

/// From inside onto the surface: mirrored back, or out.
void WalkPhotons::leave(const RayHit& hit, float cosI) {
  const float eta = 1 / medium().eta;
  const transport::Boundary boundary = transport::fresnel(cosI, eta);
  const float T = 1 - boundary.reflectance;
  if (exits_ && T > 0 && order_ >= 1)
    exits_->push_back({hit.object, {hit.triangle, hit.u, hit.v}, weight_.flux() * T});
  if (mirrorings_ > kFollowed && T > 0 && order_ >= firstOrder()) splatIfSeen(hit, weight_.flux() * T);
  if (rng_.uniform() < boundary.reflectance) {
    direction_ = transport::mirrored(direction_, hit.normal);
    mirrorings_ = std::min(mirrorings_ + 1, kUnaccounted);
  } else {
    direction_ = transport::refracted(direction_, -hit.normal, eta, cosI, boundary.cosT);
    object_ = -1;
  }
  position_ = offPoint(hit, direction_);
  clear_ = 0;
}

}  // namespace lychnite
