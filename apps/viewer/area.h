#pragma once

#include <glm/vec2.hpp>

namespace lychnite::viewer {

/// A rectangle of the window in pixels of the framebuffer, from its upper left corner.
struct Area {
  glm::dvec2 low{0}, high{0};
  glm::dvec2 size() const { return high - low; }
  bool holds(const glm::dvec2& p) const {
    return p.x >= low.x && p.y >= low.y && p.x < high.x && p.y < high.y;
  }
};

}  // namespace lychnite::viewer
