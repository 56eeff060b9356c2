#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lychnite/app/bench.h"
#include "lychnite/gpu/context.h"
#include "lychnite/technique/renderer.h"

namespace lychnite::bench {

/// How many points a growth has in all, for progress.
int growthPoints(const BenchSettings& settings);

/// Cost over resolution, map size, samples, lights and triangles; `point` is called before each.
std::vector<BenchGrowth> measureGrowth(const BenchSettings& settings, gpu::Context& context,
                                       Renderer& renderer,
                                       const std::function<void(const std::string& what)>& point);

/// What the device can do at most, by kernels that do nothing else.
BenchLimits measureLimits(gpu::Context& context, bool quick);

}  // namespace lychnite::bench
