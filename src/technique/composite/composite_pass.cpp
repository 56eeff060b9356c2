#include "technique/composite/composite_pass.h"

#include "gpu/pass.h"

namespace lychnite {
namespace {

gpu::ProgramDesc fullScreen(const std::string& label, const std::string& fragment) {
  return {.label = label, .vertex = "pass/full_screen.vert", .fragment = fragment, .defines = {}, .root = {}};
}

}  // namespace

CompositePass::CompositePass()
    : backgroundProgram_(fullScreen("background", "pass/background.frag")),
      addProgram_(fullScreen("add layer", "pass/add_layer.frag")) {}

void CompositePass::draw(const Frame& frame, const GeometryPass& geometry, const Rgb& background,
                         const std::vector<const gpu::Texture*>& layers) {
  const int width = frame.camera.width, height = frame.camera.height;
  if (!targets_ || targets_->picture.width() != width || targets_->picture.height() != height) {
    targets_.reset();
    gpu::Texture picture(
        {.label = "picture", .format = gpu::Format::kRgba32f, .width = width, .height = height});
    gpu::Framebuffer framebuffer({.label = "picture", .colours = {picture}, .depth = {}});
    targets_.emplace(Targets{std::move(picture), std::move(framebuffer)});
  }
  {
    gpu::Pass pass("background", targets_->framebuffer);
    backgroundProgram_.setTexture("geometry", geometry.samples());
    backgroundProgram_.set("background", glm::vec3(background));
    pass.drawFullScreen(backgroundProgram_);
  }
  gpu::Pass pass("add layers", targets_->framebuffer, {.blend = gpu::Blend::kAdd});
  for (const gpu::Texture* layer : layers) {
    addProgram_.setTexture("layer", *layer);
    pass.drawFullScreen(addProgram_);
  }
}

}  // namespace lychnite
