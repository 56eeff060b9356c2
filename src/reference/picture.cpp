#include "reference/picture.h"

#include <tbb/parallel_for.h>

#include <memory>

#include "lychnite/optics/profile.h"
#include "reference/surface_light.h"

namespace lychnite {

void addLayer(Image& image, const std::string& name, const std::vector<glm::vec3>& values) {
  const char* const kChannels[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    std::vector<float>& to = image.addChannel(name.empty() ? kChannels[c] : name + "." + kChannels[c]);
    for (size_t i = 0; i < values.size(); ++i) to[i] = values[i][c];
  }
}

Image assemblePicture(const RayScene& rays, const CameraReceivers& receivers, const RenderSettings& settings,
                      const PictureParts& parts) {
  Image image(receivers.width, receivers.height);
  std::vector<glm::vec3> colour(image.pixelCount());
  const glm::vec3 background(rays.scene().background);
  for (size_t i = 0; i < colour.size(); ++i) colour[i] = background * (1 - receivers.alpha(i));
  const auto part = [&](const char* name, const std::vector<glm::vec3>& values) {
    if (settings.wants(name))
      addLayer(image, name, values.empty() ? std::vector<glm::vec3>(colour.size(), glm::vec3(0)) : values);
    for (size_t i = 0; i < values.size(); ++i) colour[i] += values[i];
  };
  part("multiple", parts.multiple);
  part("single", parts.single);
  part("surface", parts.surface);
  addLayer(image, "", colour);
  addGeometryLayers(image, receivers, rays, settings);
  return image;
}

std::vector<glm::vec3> surfacePart(const RayScene& rays, const CameraReceivers& receivers) {
  std::vector<Rgb> reflectance;
  for (const Object& object : rays.scene().objects)
    reflectance.push_back(object.material.opaque ? object.material.colour
                                                 : makeDipole(object.material.medium)->P(0));
  const auto& all = receivers.receivers;
  std::vector<glm::vec3> each(all.size());
  tbb::parallel_for(size_t(0), all.size(), [&](size_t i) {
    each[i] =
        all[i].weight * glm::vec3(surfaceRadiance(rays, all[i]) +
                                  ambientRadiance(rays, all[i], reflectance[size_t(all[i].hit.object)]));
  });
  std::vector<glm::vec3> radiance(receivers.covered.size(), glm::vec3(0));
  for (size_t i = 0; i < all.size(); ++i) radiance[all[i].pixel] += each[i];
  return radiance;
}

}  // namespace lychnite
