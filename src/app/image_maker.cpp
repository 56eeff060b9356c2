#include "lychnite/app/image_maker.h"

#include <fmt/format.h>

#include "lychnite/scene/scene_file.h"

namespace lychnite {

const char* versionText() {
  return LYCHNITE_VERSION;
}

ImageMaker::ImageMaker(RendererOptions options)
    : store_(std::make_unique<ProfileStore>(defaultCacheFolder(), options.log)),
      options_(std::move(options)) {
  if (!options_.profiles) options_.profiles = store_->maker();
}

Image ImageMaker::render(const Scene& scene, const RenderSettings& settings, const Progress& progress,
                         const ReferenceOptions& reference) {
  Image image;
  lastWasRealTime_ = !isReference(settings.method);
  if (lastWasRealTime_) {
    if (!renderer_) renderer_ = std::make_unique<Renderer>(options_);
    image = renderer_->render(scene, settings, progress);
  } else {
    ReferenceOptions judge = reference;
    if (!judge.profiles) judge.profiles = options_.profiles;
    image = renderReference(scene, settings, progress, options_.log, judge);
  }
  image.metadata["lychnite"] = versionText();
  image.metadata["method"] = methodName(settings.method);
  image.metadata["components"] = componentsName(settings.components);
  image.metadata["seed"] = std::to_string(settings.seed);
  image.metadata["scene"] = sceneToToml(scene);
  return image;
}

}  // namespace lychnite
