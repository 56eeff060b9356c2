#include "technique/shading.h"

#include "technique/multiple/lattice.h"

namespace lychnite {

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
