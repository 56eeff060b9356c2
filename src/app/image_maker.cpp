#include "lychnite/app/image_maker.h"

#include <fmt/format.h>

#include "lychnite/scene/scene_file.h"

namespace lychnite {

const char* versionText() {
  return LYCHNITE_VERSION;
}

Image ImageMaker::render(const Scene& scene, const RenderSettings& settings, const Progress& progress,
                         const ReferenceOptions& walk) {
  Image image;
  lastWasRealTime_ = !isReference(settings.method);
  if (lastWasRealTime_) {
    if (!renderer_) renderer_ = std::make_unique<Renderer>(options_);
    image = renderer_->render(scene, settings, progress);
  } else {
    image = renderReference(scene, settings, progress, options_.log, walk);
  }
  image.metadata["lychnite"] = versionText();
  image.metadata["method"] = methodName(settings.method);
  image.metadata["components"] = componentsName(settings.components);
  image.metadata["seed"] = std::to_string(settings.seed);
  image.metadata["scene"] = sceneToToml(scene);
  return image;
}

}  // namespace lychnite
