#include "technique/profile_cache.h"

#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "lychnite/optics/fresnel.h"

namespace lychnite {
namespace {

gpu::Texture tableTexture(const ProfileTable& table) {
  std::vector<float> texels;
  texels.reserve(size_t(table.size()) * 8);
  for (const auto* row : {&table.RdTable(), &table.PTable()})
    for (const glm::vec3& entry : *row) texels.insert(texels.end(), {entry.x, entry.y, entry.z, 0.0f});
  gpu::Texture texture({.label = "profile",
                        .format = gpu::Format::kRgba32f,
                        .width = table.size(),
                        .height = 2,
                        .filter = gpu::Filter::kLinear});
  texture.upload(std::span<const float>(texels));
  return texture;
}

/// Where the profile has passed on all but a thousandth part of its light, in the channel that reaches
/// farthest.
double reachOf(const Profile& profile) {
  const Rgb total = profile.P(0);
  double r = 1e-9;
  for (; r < 1e9; r *= 1.2) {
    const Rgb left = profile.P(r);
    if (left.x <= 1e-3 * total.x && left.y <= 1e-3 * total.y && left.z <= 1e-3 * total.z) break;
  }
  return r;
}

/// Three times the mean core of the channels that scatter: the radius that half of the spiral's samples lie
/// within.
double spiralScaleOf(const Profile& profile) {
  const Rgb core = profile.coreLength();
  const int channels = (core.x > 0) + (core.y > 0) + (core.z > 0);
  return channels > 0 ? (core.x + core.y + core.z) * 3 / channels : 1;
}

}  // namespace

void ProfileCache::update(const Frame& frame, ProfileKind kind, const ProfileMaker& maker,
                          const Progress& progress) {
  entries_.resize(frame.objects.size());
  for (size_t i = 0; i < frame.objects.size(); ++i) {
    const FrameObject& object = frame.objects[i];
    Entry& entry = entries_[i];
    const Coefficients& m = object.medium;
    const Key key = object.translucent
                        ? Key().add(double(kind)).add(m.sigma_s).add(m.sigma_a).add(m.g).add(m.eta)
                        : Key().add(object.source->material.colour).add(m.eta);
    if (entry.key == key) continue;
    entry = Entry();
    entry.piC = std::numbers::pi * diffuseTransmittanceOutside(m.eta);
    if (object.translucent) {
      const auto profile = makeProfile(maker, {kind, m, ProfileOrders::kFromSecond}, progress);
      const ProfileTable table(*profile, 1);
      entry.table.emplace(tableTexture(table));
      entry.reach = reachOf(*profile);
      entry.spiralScale = spiralScaleOf(*profile);
      entry.scale = float(table.scale());
      entry.total = makeProfile(maker, {kind, m, ProfileOrders::kAll}, progress)->P(0);
    } else {
      entry.total = object.source->material.colour;
    }
    entry.key = key;
  }
}

}  // namespace lychnite
