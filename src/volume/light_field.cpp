#include "volume/light_field.h"

#include <algorithm>
#include <chrono>

namespace lychnite::volume {

namespace {

constexpr int kFewerReturn =
    4;  // one of so many rays is sent from surface to surface before there are photons
constexpr int kMostReturns = 3;   // times that light is sent from surface to surface
constexpr float kLittle = 0.04f;  // of the light that leaves: what is left to send then goes as a series
constexpr int kExchangeCollisions = 2;  // of light that meets another surface, before the solver takes over

// Photons tell what the beams are wrong by, which is little, and begin at the beams' solution.
constexpr double kFiner = 0.2;
constexpr double kCoarse = 0.1;  // of what their halves differ by, which tells the noise

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Lanes sumOf(const LightField::Fluxes& fluxes) {
  Lanes sum{0, 0, 0, 0};
  for (const auto& each : fluxes)
    for (const Lanes& l : each) sum += l;
  return sum;
}

}  // namespace

void LightSolver::beam(LightField& field) {
  const auto start = std::chrono::steady_clock::now();
  const size_t bodies = world_.bodies.size();
  field.passes = field.solved = field.exchangedAt = 0;
  field.emission.clear();
  field.density.assign(bodies, 0);
  field.entering = enteringFlux(world_, field.light);
  field.beamed = beamLight(world_, field.light, field.entering);
  stats_.rays += field.beamed.tally.rays;
  stats_.sourceMs += since(start);
  const auto solving = std::chrono::steady_clock::now();
  field.absorbed = field.beamed.tally.absorbed;
  field.phiBeam.resize(bodies);
  field.beam.assign(bodies, {});
  field.beamFirst.assign(bodies, {});
  for (size_t i = 0; i < bodies; ++i) {
    if (!world_.bodies[i]) continue;
    const DiffusionSystem& system = world_.bodies[i]->system;
    Deposits& deposits = field.beamed.deposits[i];
    stats_.iterations += system.solve(deposits.source, field.phiBeam[i], settings_.tolerance).iterations;
    system.exits(field.phiBeam[i], field.beam[i]);
    lastFlights_[i]->gather(*world_.bodies[i], field.phiBeam[i], deposits.source, field.beam[i]);
    field.absorbed += system.absorbed(field.phiBeam[i]);
    for (size_t n = 0; n < field.beam[i].size(); ++n) field.beam[i][n] += deposits.layer[n];
    field.beamFirst[i] = std::move(deposits.first);
    deposits = {};
  }
  stats_.solveMs += since(solving);
  field.beamAgain = lightThatReturns(field.beam, kFewerReturn);
}

void LightSolver::trace(LightField& field) {
  const auto start = std::chrono::steady_clock::now();
  if (field.emission.empty()) {
    field.emission.resize(world_.bodies.size());
    for (size_t i = 0; i < world_.bodies.size(); ++i)
      if (world_.bodies[i])
        field.emission[i] =
            Emission(world_.bodies[i]->shape->surface, field.entering[i],
                     aim_.importance.empty() ? std::vector<float>() : aim_.importance[i], settings_.photons);
  }
  Traced traced =
      traceLight(world_, field.emission, field.light, settings_.collisions, settings_.seed, field.passes);
  if (field.passes == 0) {
    for (int half : {0, 1}) field.deposits[half] = std::move(traced.deposits[half]);
    field.tally = traced.tally;
  } else {
    for (int half : {0, 1})
      for (size_t i = 0; i < world_.bodies.size(); ++i)
        if (world_.bodies[i]) field.deposits[half][i] += traced.deposits[half][i];
    field.tally += traced.tally;
  }
  for (size_t i = 0; i < field.emission.size(); ++i) field.density[i] += field.emission[i].density();
  ++field.passes;
  stats_.flights += traced.tally.flights;
  stats_.rays += traced.tally.rays;
  stats_.sourceMs += since(start);
}

/// By the mean of both halves of the photons and half their difference, of which few digits matter.
void LightSolver::solveHalves(LightField& field, size_t body) {
  const DiffusionSystem& system = world_.bodies[body]->system;
  const float each = 1 / float(field.passes);
  std::vector<Lanes> Q[2];
  for (int half : {0, 1}) Q[half] = field.deposits[half][body].source;
  for (size_t i = 0; i < Q[0].size(); ++i) {
    const Lanes a = Q[0][i], b = Q[1][i];
    Q[0][i] = each * (a + b);
    Q[1][i] = each * (a - b);
  }
  std::vector<Lanes> mean = field.phiBeam[body];  // whatever was solved for before: the same bits
  std::vector<Lanes> deviation;
  stats_.iterations += system.solve(Q[0], mean, kFiner * settings_.tolerance).iterations;
  stats_.iterations += system.solve(Q[1], deviation, kCoarse).iterations;
  for (int half : {0, 1}) field.phi[half][body] = mean;
  for (size_t i = 0; i < mean.size(); ++i) {
    field.phi[0][body][i] += deviation[i];
    field.phi[1][body][i] -= deviation[i];
  }
}

/// What leaves, by each half of the photons for itself.
void LightSolver::solve(LightField& field) {
  const auto start = std::chrono::steady_clock::now();
  const size_t bodies = world_.bodies.size();
  field.absorbed = field.tally.absorbed / double(field.passes);
  const float each = 2 / float(field.passes);
  for (int half : {0, 1}) {
    field.phi[half].resize(bodies);
    field.all[half].assign(bodies, {});
    field.first[half].assign(bodies, {});
  }
  LightField::Fluxes scattered(bodies);  // that nobody followed
  for (size_t i = 0; i < bodies; ++i) {
    if (!world_.bodies[i]) continue;
    const DiffusionSystem& system = world_.bodies[i]->system;
    solveHalves(field, i);
    scattered[i].assign(world_.bodies[i]->shape->surface.nodes().size(), Lanes{0, 0, 0, 0});
    for (int half : {0, 1}) {
      const Deposits& deposits = field.deposits[half][i];
      std::vector<Lanes> Q = deposits.source;
      for (Lanes& q : Q) q *= each;
      field.absorbed += 0.5 * system.absorbed(field.phi[half][i]);
      std::vector<Lanes>&all = field.all[half][i], &first = field.first[half][i] = deposits.first;
      system.exits(field.phi[half][i], all);
      lastFlights_[i]->gather(*world_.bodies[i], field.phi[half][i], Q, all);
      for (size_t n = 0; n < first.size(); ++n) {
        all[n] += deposits.layer[n] * each;
        scattered[i][n] += 0.5f * all[n];
        first[n] *= each;
        all[n] += first[n] + deposits.later[n] * each;
      }
    }
  }
  stats_.solveMs += since(start);
  // It is little light: made anew when the passes have doubled.
  if (field.solved == 0) field.beamAgain = lightThatReturns(field.beam, 1);
  if (field.solved == 0 || field.passes >= 2 * field.exchangedAt) {
    field.again = lightThatReturns(std::move(scattered), 1);
    field.exchangedAt = field.passes;
  }
  field.solved = field.passes;
}

/// Light that leaves, about the normal as scattered light does, meets a surface and leaves again: again and
/// again by tracing and a solve while there is much left of it; what would go on the same way then is taken
/// as a geometric series. Photons follow their own light; what diffusion sends out is left for the next
/// round.
LightField::Fluxes LightSolver::lightThatReturns(LightField::Fluxes leaving, int oneOf) {
  const auto start = std::chrono::steady_clock::now();
  LightField::Fluxes result(leaving.size());
  for (size_t i = 0; i < leaving.size(); ++i) result[i].assign(leaving[i].size(), Lanes{0, 0, 0, 0});
  const Lanes first = sumOf(leaving);
  for (int round = 0; !exchange_.empty() && round < kMostReturns; ++round) {
    const Lanes before = sumOf(leaving);
    Returned returned = returnedOnce(leaving, round, oneOf);
    leaving = std::move(returned.scattered);
    const Lanes after = sumOf(leaving);
    float most = 0;
    Lanes series{1, 1, 1, 1};
    for (int c = 0; c < 3; ++c) {
      most = std::max(most, first[c] > 0 ? after[c] / first[c] : 0);
      if (before[c] > 0) series[c] = 1 / (1 - std::min(0.9f, after[c] / before[c]));
    }
    const bool last = most < kLittle || round + 1 == kMostReturns;
    if (!last) series = Lanes{1, 1, 1, 1};
    for (size_t i = 0; i < result.size(); ++i)
      for (size_t n = 0; n < result[i].size(); ++n) result[i][n] += series * returned.all[i][n];
    if (last) break;
  }
  stats_.exchangeMs += since(start);
  return result;
}

/// What leaves of light that left and met a surface.
LightSolver::Returned LightSolver::returnedOnce(const LightField::Fluxes& leaving, int round, int oneOf) {
  Tally tally;
  const int collisions = std::min(settings_.collisions, kExchangeCollisions);
  const std::vector<Deposits> back =
      exchange_.send(world_, leaving, collisions, settings_.seed, round, oneOf, tally);
  Returned result{LightField::Fluxes(leaving.size()), LightField::Fluxes(leaving.size())};
  for (size_t i = 0; i < back.size(); ++i) {
    if (!world_.bodies[i]) continue;
    const DiffusionSystem& system = world_.bodies[i]->system;
    std::vector<Lanes> phi;
    stats_.iterations += system.solve(back[i].source, phi, std::max(0.03, settings_.tolerance)).iterations;
    system.exits(phi, result.scattered[i]);
    for (size_t n = 0; n < result.scattered[i].size(); ++n) result.scattered[i][n] += back[i].layer[n];
    result.all[i] = result.scattered[i];
    for (size_t n = 0; n < result.all[i].size(); ++n) result.all[i][n] += back[i].first[n] + back[i].later[n];
  }
  return result;
}

}  // namespace lychnite::volume
