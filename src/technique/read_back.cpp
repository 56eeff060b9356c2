#include "technique/read_back.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace lychnite {
namespace {

glm::vec3 octDecode(glm::vec2 p) {
  glm::vec3 n(p.x, p.y, 1 - std::abs(p.x) - std::abs(p.y));
  if (n.z < 0)
    n = {(1 - std::abs(p.y)) * (p.x >= 0 ? 1.0f : -1.0f), (1 - std::abs(p.x)) * (p.y >= 0 ? 1.0f : -1.0f),
         n.z};
  return glm::normalize(n);
}

/// Start of the image row that is row `y` of the texture, which counts from below.
size_t rowStart(const Image& image, int y) {
  return size_t(image.height() - 1 - y) * size_t(image.width());
}

}  // namespace

void readPicture(const gpu::Texture& texture, Image& image) {
  const std::vector<float> texels = texture.download();
  const std::array<std::vector<float>*, 4> targets{&image.addChannel("R"), &image.addChannel("G"),
                                                   &image.addChannel("B"), &image.addChannel("A")};
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (size_t c = 0; c < 4; ++c)
        (*targets[c])[rowStart(image, y) + size_t(x)] =
            texels[(size_t(y) * size_t(image.width()) + size_t(x)) * 4 + c];
}

void readLayer(const std::vector<const gpu::Texture*>& layers, Image& image, const std::string& name) {
  const std::array<std::vector<float>*, 3> targets{
      &image.addChannel(name + ".R"), &image.addChannel(name + ".G"), &image.addChannel(name + ".B")};
  for (const gpu::Texture* layer : layers) {
    const std::vector<float> texels = layer->download();
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        for (size_t c = 0; c < 3; ++c)
          (*targets[c])[rowStart(image, y) + size_t(x)] +=
              texels[(size_t(y) * size_t(image.width()) + size_t(x)) * 4 + c];
  }
}

void readGeometry(const gpu::Texture& samples, const Frame& frame, Image& image, bool depth, bool normal) {
  const std::vector<float> texels = samples.download();
  std::vector<float>* Z = depth ? &image.addChannel("depth.Z") : nullptr;
  std::array<std::vector<float>*, 3> N{};
  if (normal)
    N = {&image.addChannel("normal.X"), &image.addChannel("normal.Y"), &image.addChannel("normal.Z")};
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      float sum = 0;
      int count = 0;
      glm::vec3 n(0);
      for (int i = 0; i < 4; ++i) {
        const size_t at = (size_t(2 * y + (i >> 1)) * size_t(samples.width()) + size_t(2 * x + (i & 1))) * 4;
        if (texels[at + 3] <= 0) continue;
        sum += texels[at];
        n += octDecode({texels[at + 1], texels[at + 2]});
        ++count;
      }
      if (count == 0) continue;
      const size_t pixel = rowStart(image, y) + size_t(x);
      if (depth) (*Z)[pixel] = float(sum / float(count) * frame.unit);
      if (!normal) continue;
      n = glm::length(n) > 0 ? glm::normalize(n) : glm::vec3(0);
      for (int c = 0; c < 3; ++c) (*N[size_t(c)])[pixel] = n[c];
    }
  }
}

}  // namespace lychnite
