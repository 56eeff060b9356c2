#include "technique/layer.h"

#include "gpu/pass.h"

namespace lychnite {

bool Layer::update(const std::string& label, const Key& key, const Frame& frame, const Shade& shade) {
  const int width = frame.camera.width, height = frame.camera.height;
  const bool fits = targets_ && targets_->texture.width() == width && targets_->texture.height() == height;
  if (fits && key == key_) return false;
  key_ = Key();
  if (!fits) {
    targets_.reset();
    gpu::Texture texture({.label = label, .format = gpu::Format::kRgba32f, .width = width, .height = height});
    gpu::Framebuffer framebuffer({.label = label, .colours = {texture}, .depth = {}});
    targets_.emplace(Targets{std::move(texture), std::move(framebuffer)});
  }
  targets_->framebuffer.clearColour(0, {0, 0, 0, 0});
  for (size_t i = 0; i < frame.objects.size(); ++i) {
    const gpu::Rect bounds = screenBounds(frame, frame.objects[i]);
    if (bounds.width > 0 && bounds.height > 0) shade(i, {targets_->framebuffer, targets_->texture, bounds});
  }
  key_ = key;
  return true;
}

bool Layer::update(const std::string& label, const Key& key, const Frame& frame, const GeometryPass& geometry,
                   const Prepare& prepare) {
  return update(label, key, frame, [&](size_t object, const Target& target) {
    gpu::Program* program = prepare(object);
    if (!program) return;
    setReceiverUniforms(*program, frame, geometry.samples(), object);
    gpu::Pass pass(label, target.framebuffer, {.blend = gpu::Blend::kAdd, .scissor = target.bounds});
    pass.drawFullScreen(*program);
  });
}

}  // namespace lychnite
