#include "technique/profile_cache.h"

#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "lychnite/optics/fresnel.h"
#include "technique/multiple/spiral.h"

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
      entry.reach = spiralReach(*profile);
      entry.spiralScale = spiralScale(*profile);
      entry.coreLength = entry.spiralScale / 3;
      entry.scale = float(table.scale());
      entry.total = makeProfile(maker, {kind, m, ProfileOrders::kAll}, progress)->P(0);
    } else {
      entry.total = object.source->material.colour;
    }
    entry.key = key;
  }
}

}  // namespace lychnite
