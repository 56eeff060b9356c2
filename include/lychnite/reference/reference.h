#pragma once

#include "lychnite/base/log.h"
#include "lychnite/base/progress.h"
#include "lychnite/image/image.h"
#include "lychnite/scene/scene.h"
#include "lychnite/scene/settings.h"

namespace lychnite {

/// Renders a scene on the CPU by settings.method (dipole, hierarchical or walk). Same picture conventions as
/// the real-time Renderer: 2 x 2 geometry samples a pixel at (.25, .75), colour over background, A =
/// coverage. Metadata record what was done (samples, estimated error, seconds). Throws Error; an interrupted
/// walk returns what it has with metadata "interrupted" = "true", the others throw Interrupted.
Image renderReference(const Scene& scene, const RenderSettings& settings, const Progress& progress = {},
                      const LogSink& log = {});

}  // namespace lychnite
