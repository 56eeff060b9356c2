#pragma once

#include "gpu/object.h"

namespace lychnite::gpu {

/// The one way to another object's driver name; included by gpu's own sources only.
struct ObjectAccess {
  static uint32_t id(const Object& object) { return object.id_; }
};

}  // namespace lychnite::gpu
