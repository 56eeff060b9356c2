#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "gpu/buffer.h"
#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/vertex_array.h"

namespace lychnite::gpu {

enum class DepthTest { kOff, kAlways, kLess, kLessEqual, kEqual, kGreater };
enum class Blend { kNone, kAdd, kMin, kMax };
enum class Cull { kNone, kBack, kFront };

/// A rectangle of pixels; (x, y) is the lower left corner.
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Everything a pass fixes of the pipeline. Nothing is inherited from the pass before.
struct PassState {
  DepthTest depthTest = DepthTest::kOff;
  bool depthWrite = false;  ///< has no effect with kOff
  Blend blend = Blend::kNone;
  Cull cull = Cull::kNone;
  std::array<bool, 4> colourMask{true, true, true, true};
  std::optional<Rect> viewport{};  ///< default: the whole framebuffer
  std::optional<Rect> scissor{};   ///< default: none
};

/// The time during which draws go into one framebuffer under one state; a named group for the debugger.
/// Passes do not nest.
class Pass {
 public:
  Pass(const std::string& label, const Framebuffer& target, const PassState& state = {});
  ~Pass();
  Pass(const Pass&) = delete;
  Pass& operator=(const Pass&) = delete;

  /// One triangle over the whole viewport. The vertex shader makes it from gl_VertexID (0, 1, 2), without
  /// attributes.
  void drawFullScreen(const Program& program);
  /// All triangles of a mesh. An empty mesh draws nothing.
  void drawMesh(const Program& program, const VertexArray& mesh);

 private:
  std::shared_ptr<ContextState> state_;
};

/// Runs a compute program, outside any pass, in as many work groups as the beginning of a buffer says:
/// columns, rows and layers. What shaders wrote to storage before is seen here, and what this one writes to
/// storage and images by all draws and dispatches after.
void dispatch(const std::string& label, const Program& program, const Buffer& groups);

}  // namespace lychnite::gpu
