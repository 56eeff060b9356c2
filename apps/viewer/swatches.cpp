#include "swatches.h"

#include <fmt/format.h>

#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene_file.h"
#include "technique/renderer_textures.h"

namespace lychnite::viewer {

Swatches::Swatches(const RendererOptions& options) : options_(options), swatches_(materialLibrary().size()) {
  scene_.objects.push_back(loadObject("sphere"));
  scene_.lights = {ParallelLight{.azimuth = 130, .elevation = 30},
                   ParallelLight{.azimuth = -40, .elevation = 40, .irradiance = Rgb(0.6)}};
  scene_.camera = OrbitCamera{.azimuth = 0, .elevation = 10, .factor = 1.08};
  scene_.background = Rgb(0.012, 0.012, 0.013);
  scene_.ambient = Rgb(0.02);
}

void Swatches::want(double size, int pixels, const ToneMapping& toneMapping) {
  scene_.objects.front().size = size;
  pixels_ = pixels;
  toneMapping_ = toneMapping;
  key_ = fmt::format("{} {} {} {}", size, pixels, toneCurveName(toneMapping.curve), toneMapping.exposure);
}

bool Swatches::drawOne(Display& display) {
  for (size_t i = 0; i < swatches_.size(); ++i) {
    std::optional<Swatch>& swatch = swatches_[i];
    if (swatch && swatch->key == key_) continue;
    if (!renderer_) renderer_ = std::make_unique<Renderer>(options_);
    scene_.objects.front().material.medium = materialLibrary()[i].coefficients;
    renderer_->draw(scene_, {.width = pixels_,
                             .height = pixels_,
                             .multipleSamples = 16,
                             .singleSamples = 4,
                             .mapSize = 128,
                             .mostMapSize = 128});
    if (!swatch || swatch->texture.width() != pixels_) {
      swatch.reset();
      gpu::Texture texture({.label = "swatch",
                            .format = gpu::Format::kRgba8,
                            .width = pixels_,
                            .height = pixels_,
                            .filter = gpu::Filter::kLinear});
      gpu::Framebuffer framebuffer({.label = "swatch", .colours = {texture}, .depth = {}});
      swatch.emplace(Swatch{std::move(texture), std::move(framebuffer), ""});
    }
    display.draw(swatch->framebuffer, {.area = {0, 0, pixels_, pixels_},
                                       .left = &RendererTextures::picture(*renderer_),
                                       .toneMapping = toneMapping_});
    swatch->key = key_;
    return true;
  }
  return false;
}

const gpu::Texture* Swatches::texture(size_t material) const {
  return swatches_[material] ? &swatches_[material]->texture : nullptr;
}

}  // namespace lychnite::viewer
