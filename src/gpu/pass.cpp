#include "gpu/pass.h"

#include <epoxy/gl.h>

#include <cassert>

#include "gpu/context_state.h"
#include "gpu/object_access.h"
#include "gpu/program_access.h"

namespace lychnite::gpu {
namespace {

void enable(GLenum what, bool on) {
  on ? glEnable(what) : glDisable(what);
}

GLenum depthFunction(DepthTest test) {
  switch (test) {
    case DepthTest::kLess:
      return GL_LESS;
    case DepthTest::kLessEqual:
      return GL_LEQUAL;
    case DepthTest::kEqual:
      return GL_EQUAL;
    case DepthTest::kGreater:
      return GL_GREATER;
    case DepthTest::kOff:
    case DepthTest::kAlways:
      return GL_ALWAYS;
  }
  return GL_ALWAYS;
}

void setBlend(Blend blend) {
  enable(GL_BLEND, blend != Blend::kNone);
  glBlendFunc(GL_ONE, GL_ONE);
  glBlendEquation(blend == Blend::kMin ? GL_MIN : blend == Blend::kMax ? GL_MAX : GL_FUNC_ADD);
}

void setState(const Framebuffer& target, const PassState& state) {
  enable(GL_DEPTH_TEST, state.depthTest != DepthTest::kOff);
  glDepthFunc(depthFunction(state.depthTest));
  glDepthMask(state.depthWrite);
  setBlend(state.blend);
  enable(GL_CULL_FACE, state.cull != Cull::kNone);
  glCullFace(state.cull == Cull::kFront ? GL_FRONT : GL_BACK);
  const auto& mask = state.colourMask;
  glColorMask(mask[0], mask[1], mask[2], mask[3]);
  const Rect view = state.viewport.value_or(Rect{0, 0, target.width(), target.height()});
  glViewport(view.x, view.y, view.width, view.height);
  enable(GL_SCISSOR_TEST, state.scissor.has_value());
  if (state.scissor)
    glScissor(state.scissor->x, state.scissor->y, state.scissor->width, state.scissor->height);
}

}  // namespace

Pass::Pass(const std::string& label, const Framebuffer& target, const PassState& state)
    : state_(currentState()) {
  assert(!state_->inPass && "passes do not nest");
  state_->inPass = true;
  glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, label.c_str());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, ObjectAccess::id(target));
  setState(target, state);
}

Pass::~Pass() {
  // Clears and copies between passes look at these.
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glPopDebugGroup();
  state_->inPass = false;
}

void Pass::drawFullScreen(const Program& program) {
  ProgramAccess::bind(program);
  glBindVertexArray(state_->emptyVertexArray);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Pass::drawMesh(const Program& program, const VertexArray& mesh) {
  if (mesh.triangles() == 0) return;
  ProgramAccess::bind(program);
  glBindVertexArray(ObjectAccess::id(mesh));
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * mesh.triangles()), GL_UNSIGNED_INT, nullptr);
}

void dispatch(const std::string& label, const Program& program, const Buffer& groups) {
  assert(!currentState()->inPass);
  glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, label.c_str());
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  ProgramAccess::bind(program);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, ObjectAccess::id(groups));
  glDispatchComputeIndirect(0);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                  GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_FRAMEBUFFER_BARRIER_BIT);
  glPopDebugGroup();
}

}  // namespace lychnite::gpu
