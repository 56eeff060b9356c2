#include "technique/shading.h"

#include <algorithm>

#include "gpu/pass.h"
#include "technique/multiple/lattice.h"
#include "technique/multiple/spiral.h"

namespace lychnite {
namespace {

gpu::Program shadingProgram(const std::string& label, const std::string& fragment,
                            gpu::ShaderDefines defines = {}) {
  return gpu::Program({.label = label,
                       .vertex = "pass/full_screen.vert",
                       .fragment = fragment,
                       .defines = std::move(defines),
                       .root = {}});
}

/// Everything that a layer of one light shows, but for the component's own parameters.
Key commonKey(const ShadingInputs& in, size_t light) {
  Key key = in.geometry.key();
  for (size_t i = 0; i < in.frame.objects.size(); ++i) {
    const Material& material = in.frame.objects[i].source->material;
    const LightMapPass::Map& map = in.maps.get(i, light);
    key.add(map.key)
        .add(map.view.power)
        .add(in.profiles.get(i).key)
        .add(material.roughness)
        .add(material.opaque);
  }
  return key;
}

}  // namespace

MultipleLatticeShading::MultipleLatticeShading()
    : adaptive_(shadingProgram("adaptive", "pass/multiple_lattice.frag", {{"LAYOUT", "2"}})),
      fixed_(shadingProgram("fixed", "pass/multiple_lattice.frag", {{"LAYOUT", "5"}})) {}

bool MultipleLatticeShading::update(Layer& layer, const ShadingInputs& in, size_t light) {
  const bool fixed = in.settings.method == Method::kFixed;
  const LatticeConstants& constants = in.settings.lattice;
  Key key = Key().add(commonKey(in, light)).add(fixed).add(constants.C1).add(constants.C2).add(constants.K);
  for (const FrameObject& object : in.frame.objects) key.add(object.source->size);
  return layer.update("multiple", key, in.frame, in.geometry, [&](size_t i) -> gpu::Program* {
    if (!in.frame.objects[i].translucent) return nullptr;
    gpu::Program& program = fixed ? fixed_ : adaptive_;
    setUniforms(program, in, i, light);
    program.set("piC", in.profiles.get(i).piC);
    return &program;
  });
}

void MultipleLatticeShading::setUniforms(gpu::Program& program, const ShadingInputs& in, size_t i,
                                         size_t light) {
  const bool fixed = in.settings.method == Method::kFixed;
  const FrameObject& object = in.frame.objects[i];
  const LightMapPass::Map& map = in.maps.get(i, light);
  const ProfileCache::Entry& profile = in.profiles.get(i);
  map.view.setUniforms(program);
  program.setTexture("map", fixed ? *map.normal : *map.cosine);
  if (fixed) program.setTexture("mapDepth", *map.normalDepth);
  program.setTexture("profile", *profile.table);
  program.set("profileScale", profile.scale);
  program.set("eta", object.medium.eta);
  const Coefficients& medium = object.source->material.medium;
  const double size = fixed ? latticeReferenceSize(medium) : object.source->size;
  const int levels = (fixed ? *map.normal : *map.cosine).levels();
  const auto cells = makeLattice(latticeSlope(in.settings.lattice, medium, size), levels - 1);
  program.set("lattice", std::span<const glm::vec4>(cells));
}

MultipleMatchedShading::MultipleMatchedShading()
    : coarseProgram_(shadingProgram("matched, coarse", "pass/multiple_matched_coarse.frag")),
      program_(shadingProgram("matched", "pass/multiple_matched.frag")) {}

const gpu::Texture& MultipleMatchedShading::azimuths() {
  if (azimuths_) return *azimuths_;
  azimuths_.emplace(gpu::TextureDesc{.label = "azimuths",
                                     .format = gpu::Format::kRg32f,
                                     .width = kAzimuthColumns,
                                     .height = kAzimuthRows,
                                     .filter = gpu::Filter::kLinear});
  const std::vector<glm::vec2> table = azimuthTable();
  azimuths_->upload(std::span<const float>(&table[0].x, table.size() * 2));
  return *azimuths_;
}

MultipleMatchedShading::Coarse& MultipleMatchedShading::coarse(const CameraFrame& camera) {
  // A last odd row or column has no whole block; its pixels are evaluated for themselves.
  const int width = std::max(1, camera.width / 2), height = std::max(1, camera.height / 2);
  if (coarse_ && coarse_->radiosity.width() == width && coarse_->radiosity.height() == height)
    return *coarse_;
  coarse_.reset();
  const auto texture = [&](const char* label) {
    return gpu::Texture({.label = label, .format = gpu::Format::kRgba32f, .width = width, .height = height});
  };
  gpu::Texture radiosity = texture("coarse radiosity"), surface = texture("coarse surface");
  gpu::Framebuffer framebuffer({.label = "coarse", .colours = {radiosity, surface}, .depth = {}});
  coarse_.emplace(Coarse{std::move(radiosity), std::move(surface), std::move(framebuffer)});
  return *coarse_;
}

void MultipleMatchedShading::setUniforms(gpu::Program& program, const ShadingInputs& in, size_t object,
                                         size_t light) {
  const FrameObject& target = in.frame.objects[object];
  const LightMapPass::Map& map = in.maps.get(object, light);
  const ProfileCache::Entry& profile = in.profiles.get(object);
  map.view.setUniforms(program);
  program.setTexture("moments", *map.moments);
  program.setTexture("profile", *profile.table);
  program.setTexture("azimuths", azimuths());
  program.set("profileScale", profile.scale);
  program.set("centreDepth", map.view.centreDepth);
  program.set("boundRadius", target.bounds.radius);
  program.set("spiralScale", profile.spiralScale);
  program.set("reach", profile.reach);
  program.set("sampleCount", in.settings.multipleSamples);
  program.set("mostRefinement", float(kMostRefinement));
}

void MultipleMatchedShading::drawCoarse(const ShadingInputs& in, size_t object, size_t light) {
  Coarse& target = coarse(in.frame.camera);
  target.framebuffer.clearColour(0, {0, 0, 0, 0});
  setUniforms(coarseProgram_, in, object, light);
  setReceiverUniforms(coarseProgram_, in.frame, in.geometry.samples(), object);
  const gpu::Rect fine = screenBounds(in.frame, in.frame.objects[object]);
  const gpu::Rect bounds{fine.x / 2, fine.y / 2, fine.width / 2 + 2, fine.height / 2 + 2};
  gpu::Pass pass("matched, coarse", target.framebuffer, {.scissor = bounds});
  pass.drawFullScreen(coarseProgram_);
}

bool MultipleMatchedShading::update(Layer& layer, const ShadingInputs& in, size_t light) {
  constexpr double kMatched = 2;  // tells its key from the lattice's, whose first own number is 0 or 1
  const double interpolation =
      std::min(in.frame.camera.width, in.frame.camera.height) < 2 ? 0 : in.settings.interpolation;
  const Key key =
      Key().add(commonKey(in, light)).add(kMatched).add(in.settings.multipleSamples).add(interpolation);
  return layer.update("multiple", key, in.frame, in.geometry, [&](size_t i) -> gpu::Program* {
    if (!in.frame.objects[i].translucent) return nullptr;
    if (interpolation > 0) drawCoarse(in, i, light);
    const Coarse& neighbours = coarse(in.frame.camera);
    setUniforms(program_, in, i, light);
    program_.setTexture("coarseRadiosity", neighbours.radiosity);
    program_.setTexture("coarseSurface", neighbours.surface);
    program_.set("interpolation", interpolation);
    program_.set("eta", in.frame.objects[i].medium.eta);
    program_.set("piC", in.profiles.get(i).piC);
    return &program_;
  });
}

SingleShading::SingleShading() : program_(shadingProgram("single", "pass/single.frag")) {}

bool SingleShading::update(Layer& layer, const ShadingInputs& in, size_t light) {
  const Key key = Key().add(commonKey(in, light)).add(in.settings.singleSamples);
  return layer.update("single", key, in.frame, in.geometry, [&](size_t i) -> gpu::Program* {
    const FrameObject& object = in.frame.objects[i];
    if (!object.translucent) return nullptr;
    const LightMapPass::Map& map = in.maps.get(i, light);
    map.view.setUniforms(program_);
    program_.setTexture("map", *map.cosine);
    program_.setTexture("farDepth", *map.farDepth);
    program_.set("sampleCount", in.settings.singleSamples);
    program_.set("sigma_s", glm::vec3(object.medium.sigma_s));
    program_.set("sigma_t", glm::vec3(object.medium.sigma_t()));
    program_.set("g", object.medium.g);
    program_.set("eta", object.medium.eta);
    program_.set("boundCentre", glm::vec3(object.bounds.centre));
    program_.set("boundRadius", float(object.bounds.radius));
    return &program_;
  });
}

SurfaceShading::SurfaceShading() : program_(shadingProgram("surface", "pass/surface.frag")) {}

bool SurfaceShading::update(Layer& layer, const ShadingInputs& in, size_t light) {
  return layer.update("surface", commonKey(in, light), in.frame, in.geometry, [&](size_t i) -> gpu::Program* {
    const FrameObject& object = in.frame.objects[i];
    const LightMapPass::Map& map = in.maps.get(i, light);
    map.view.setUniforms(program_);
    program_.setTexture("map", *map.cosine);
    program_.set("base", object.translucent ? glm::vec3(0) : glm::vec3(object.source->material.colour));
    program_.set("eta", object.medium.eta);
    program_.set("roughness", object.source->material.roughness);
    program_.set("piC", in.profiles.get(i).piC);
    return &program_;
  });
}

AmbientShading::AmbientShading() : program_(shadingProgram("ambient", "pass/ambient.frag")) {}

bool AmbientShading::update(Layer& layer, const ShadingInputs& in, const Rgb& ambient) {
  Key key = in.geometry.key();
  key.add(ambient);
  for (size_t i = 0; i < in.frame.objects.size(); ++i) key.add(in.profiles.get(i).key);
  return layer.update("ambient", key, in.frame, in.geometry, [&](size_t i) {
    program_.set("ambient", glm::vec3(ambient));
    program_.set("reflectance", glm::vec3(in.profiles.get(i).total));
    program_.set("eta", in.frame.objects[i].medium.eta);
    program_.set("piC", in.profiles.get(i).piC);
    return &program_;
  });
}

}  // namespace lychnite
