#pragma once

#include <optional>

#include "gpu/pass.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "lychnite/app/view_state.h"

namespace lychnite::viewer {

/// Shows linear pictures on a window or a texture (shaders/view/display.frag).
class Display {
 public:
  /// A layer of a frame instead of a picture.
  struct Layer {
    int kind = 0;  ///< 1 depth, 2 normal, 3 map's flux, 4 map's cosine
    const gpu::Texture* texture = nullptr;
    double low = 0, high = 1, level = 0;
  };
  struct Frame {
    gpu::Rect area;                       ///< of the target, from its lower left corner
    const gpu::Texture* left = nullptr;   ///< rgb and coverage
    const gpu::Texture* right = nullptr;  ///< for a comparison
    CompareView compare{};
    double meanOfRight = 1;
    ToneMapping toneMapping{};
    std::optional<Layer> layer{};
    const Scene* grid = nullptr;  ///< draws the ground's grid for this scene
  };

  Display();
  void draw(const gpu::Framebuffer& target, const Frame& frame);

 private:
  void setGrid(const Frame& frame);
  gpu::Program program_;
};

/// Distance in mm between the ground's thin lines (every fifth is a thick one): 1, 2 or 5 times a power of
/// ten, about a tenth of the subject.
double gridSpacing(const Scene& scene);
/// Height of the ground: the lower side of the subject's box (of its sphere when it is turned).
double groundHeight(const Scene& scene);

}  // namespace lychnite::viewer
