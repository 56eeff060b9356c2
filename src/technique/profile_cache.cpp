#include "technique/profile_cache.h"

#include <numbers>

#include "lychnite/optics/fresnel.h"

namespace lychnite {
namespace {

gpu::Texture tableTexture(const std::vector<glm::vec3>& table) {
  std::vector<float> texels;
  texels.reserve(table.size() * 4);
  for (const glm::vec3& entry : table) texels.insert(texels.end(), {entry.x, entry.y, entry.z, 0.0f});
  gpu::Texture texture({.label = "profile",
                        .format = gpu::Format::kRgba32f,
                        .width = int(table.size()),
                        .height = 1,
                        .filter = gpu::Filter::kLinear});
  texture.upload(std::span<const float>(texels));
  return texture;
}

}  // namespace

void ProfileCache::update(const Frame& frame, ProfileKind kind) {
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
      const auto profile = makeProfile(kind, m);
      const ProfileTable table(*profile, 1);
      entry.Rd.emplace(tableTexture(table.RdTable()));
      entry.scale = float(table.scale());
      entry.total = profile->P(0);
    } else {
      entry.total = object.source->material.colour;
    }
    entry.key = key;
  }
}

}  // namespace lychnite
