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
  const Method method = resolved(settings);
  lastWasRealTime_ = !isReference(method) && method != Method::kVolume;
  if (lastWasRealTime_) {
    image = renderRealTime(scene, settings, progress);
  } else if (method == Method::kVolume) {
    image = renderVolume(scene, settings, progress);
  } else {
    ReferenceOptions judge = reference;
    if (!judge.profiles) judge.profiles = options_.profiles;
    image = renderReference(scene, settings, progress, options_.log, judge);
  }
  image.metadata["lychnite"] = versionText();
  const bool fellBack = method == Method::kVolume && lastWasRealTime_;
  image.metadata["method"] =
      methodName(fellBack && settings.method == Method::kAuto ? Method::kMatched : method);
  image.metadata["components"] = componentsName(settings.components);
  image.metadata["seed"] = std::to_string(settings.seed);
  image.metadata["scene"] = sceneToToml(scene);
  return image;
}

Image ImageMaker::renderRealTime(const Scene& scene, const RenderSettings& settings,
                                 const Progress& progress) {
  if (!renderer_) renderer_ = std::make_unique<Renderer>(options_);
  return renderer_->render(scene, settings, progress);
}

/// By the solver; where an object has no inside, by `matched`, and the picture says so.
Image ImageMaker::renderVolume(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  validate(scene);
  validate(settings);
  if (!volume_) volume_ = std::make_unique<VolumeSolver>();
  const std::string obstacle = volume_->obstacle(scene);
  if (!obstacle.empty()) {
    logTo(options_.log, LogLevel::kWarning, "volume: " + obstacle + "; rendered by matched instead");
    RenderSettings instead = settings;
    instead.method = Method::kMatched;
    std::erase(instead.aovs, "stderr");
    lastWasRealTime_ = true;
    Image image = renderRealTime(scene, instead, progress);
    image.metadata["fallback"] = "matched: " + obstacle;
    return image;
  }
  return volume_->render(scene, settings, progress);
}

}  // namespace lychnite
