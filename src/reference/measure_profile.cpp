#include "lychnite/reference/measure_profile.h"

#include <cmath>
#include <glm/exponential.hpp>

#include "lychnite/optics/fresnel.h"
#include "lychnite/reference/slab.h"

namespace lychnite {
namespace {

constexpr int kRingsPerOctave = 4, kOctaves = 19;
constexpr double kFirst =
    1.0 / 256;  // radius of the innermost ring, in mean free paths, of reduced ones where g > 0

std::vector<double> ringEdges(double g) {
  std::vector<double> edges{0};
  for (int i = 0; i <= kRingsPerOctave * kOctaves; ++i)
    edges.push_back(kFirst / (1 - std::fmax(g, 0.0)) * std::exp2(double(i) / kRingsPerOctave));
  return edges;
}

/// Shares of the arriving power turned into shares of what entered. Deviations of differences are taken as if
/// the parts were independent.
MeasuredProfile::Part partOf(const SlabShare& total, const std::vector<SlabShare>& rings, double entered) {
  MeasuredProfile::Part part{total.value / entered, {}, {}};
  for (const SlabShare& ring : rings) {
    part.exitance.push_back(ring.value / entered);
    part.deviation.push_back(ring.standardError / entered);
  }
  return part;
}

SlabShare difference(const SlabShare& a, const SlabShare& b) {
  return {a.value - b.value,
          glm::sqrt(a.standardError * a.standardError + b.standardError * b.standardError)};
}

}  // namespace

MeasuredProfile measureProfile(const ProfileMeasurement& m, const Progress& progress) {
  SlabSettings settings;
  settings.medium = {.sigma_s = m.albedo, .sigma_a = 1.0 - m.albedo, .g = m.g, .eta = m.eta};
  settings.diffuse = true;
  settings.photons = m.photons;
  settings.seed = m.seed;
  settings.ringEdges = ringEdges(m.g);
  const SlabResult slab = simulateSlab(settings, Progress([&](const Progress::Update& update) {
                                         return progress.update({"profile", update.fraction, update.detail});
                                       }));
  MeasuredProfile result{.ringEdges = settings.ringEdges, .all = {}, .fromSecond = {}};
  const double entered = diffuseTransmittanceOutside(m.eta);
  result.all = partOf(slab.diffuse_reflectance, slab.radialReflectance, entered);
  std::vector<SlabShare> rings;
  for (size_t i = 0; i < slab.radialReflectance.size(); ++i)
    rings.push_back(difference(slab.radialReflectance[i], slab.radialReflectanceOnce[i]));
  result.fromSecond = partOf(difference(slab.diffuse_reflectance, slab.reflectance_once), rings, entered);
  return result;
}

}  // namespace lychnite
