#include "technique/shading_inputs.h"

namespace lychnite {

gpu::Program shadingProgram(const std::string& label, const std::string& fragment,
                            gpu::ShaderDefines defines) {
  return gpu::Program({.label = label,
                       .vertex = "pass/full_screen.vert",
                       .fragment = fragment,
                       .defines = std::move(defines),
                       .root = {}});
}

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

}  // namespace lychnite
