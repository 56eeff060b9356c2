#pragma once

#include "gpu/program.h"

namespace lychnite::gpu {

/// Lets a pass make a program, its textures and its blocks the ones the next draw uses.
struct ProgramAccess {
  static void bind(const Program& program) { program.bind(); }
};

}  // namespace lychnite::gpu
