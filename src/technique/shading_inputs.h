#pragma once

#include "gpu/program.h"
#include "lychnite/scene/settings.h"
#include "technique/layer.h"
#include "technique/light_map/light_map_pass.h"
#include "technique/profile_cache.h"

namespace lychnite {

/// What a component of the light is shaded from.
struct ShadingInputs {
  const Frame& frame;
  const GeometryPass& geometry;
  const LightMapPass& maps;
  const ProfileCache& profiles;
  const RenderSettings& settings;
};

/// A program that shades a layer. `label` is also the debugger's, `fragment` a file below the shader folder.
gpu::Program shadingProgram(const std::string& label, const std::string& fragment,
                            gpu::ShaderDefines defines = {});

/// Everything that a layer of one light shows, but for the component's own parameters.
Key commonKey(const ShadingInputs& in, size_t light);

}  // namespace lychnite
