#include "gpu/framebuffer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>

#include "gpu/context_state.h"
#include "gpu/object_access.h"
#include "lychnite/base/error.h"

namespace lychnite::gpu {
namespace {

uint32_t createFramebuffer() {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  return id;
}

void deleteFramebuffer(uint32_t id) {
  glDeleteFramebuffers(1, &id);
}

std::string incompleteReason(GLenum status) {
  switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
      return "an attachment cannot be drawn into";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
      return "nothing is attached";
    case GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER:
      return "an output has no attachment";
    case GL_FRAMEBUFFER_UNSUPPORTED:
      return "the driver does not support this combination of formats";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
      return "the attachments differ in samples";
    default:
      return "framebuffer status " + std::to_string(status);
  }
}

void drawToAll(GLuint id, int colours) {
  std::vector<GLenum> outputs(std::max(colours, 1), GL_NONE);
  for (int i = 0; i < colours; ++i) outputs[i] = GL_COLOR_ATTACHMENT0 + i;
  glNamedFramebufferDrawBuffers(id, static_cast<GLsizei>(outputs.size()), outputs.data());
}

}  // namespace

Framebuffer::Framebuffer(const FramebufferDesc& desc)
    : Object(createFramebuffer(), GL_FRAMEBUFFER, deleteFramebuffer, desc.label),
      colours_(static_cast<int>(desc.colours.size())) {
  const auto attach = [this](GLenum point, const Attachment& attachment) {
    const Texture& texture = *attachment.texture;
    assert(attachment.level >= 0 && attachment.level < texture.levels());
    assert(width_ == 0 ||
           (width_ == texture.width(attachment.level) && height_ == texture.height(attachment.level)));
    width_ = texture.width(attachment.level);
    height_ = texture.height(attachment.level);
    glNamedFramebufferTexture(id(), point, ObjectAccess::id(texture), attachment.level);
  };
  for (int i = 0; i < colours_; ++i) attach(GL_COLOR_ATTACHMENT0 + i, desc.colours[i]);
  if (desc.depth) attach(GL_DEPTH_ATTACHMENT, *desc.depth);
  drawToAll(id(), colours_);
  const GLenum status = glCheckNamedFramebufferStatus(id(), GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Error({.where = "framebuffer '" + desc.label + "'",
                 .expected = "a combination of textures this driver can draw into",
                 .found = incompleteReason(status),
                 .todo = ""},
                Error::Kind::kDevice);
}

Framebuffer::Framebuffer(int width, int height)
    : Object(0, GL_FRAMEBUFFER, deleteFramebuffer, "window"), width_(width), height_(height), colours_(1) {}

Framebuffer Framebuffer::ofWindow(int width, int height) {
  return {width, height};
}

std::vector<uint8_t> Framebuffer::readBytes() const {
  assert(!state().inPass);
  std::vector<uint8_t> bytes(size_t(width_) * size_t(height_) * 4);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, id());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  return bytes;
}

void Framebuffer::clearColour(int index, const std::array<float, 4>& value) {
  assert(!state().inPass && index < colours_);
  glClearNamedFramebufferfv(id(), GL_COLOR, index, value.data());
}

void Framebuffer::clearColour(int index, uint32_t value) {
  assert(!state().inPass && index < colours_);
  const std::array<GLuint, 4> all{value, value, value, value};
  glClearNamedFramebufferuiv(id(), GL_COLOR, index, all.data());
}

void Framebuffer::clearDepth(float value) {
  assert(!state().inPass);
  glClearNamedFramebufferfv(id(), GL_DEPTH, 0, &value);
}

void Framebuffer::resolveColour(int index, Framebuffer& target, int targetIndex) const {
  assert(!state().inPass && index < colours_ && targetIndex < target.colours_);
  assert(width_ == target.width_ && height_ == target.height_);
  glNamedFramebufferReadBuffer(id(), GL_COLOR_ATTACHMENT0 + index);
  glNamedFramebufferDrawBuffer(target.id(), GL_COLOR_ATTACHMENT0 + targetIndex);
  glBlitNamedFramebuffer(id(), target.id(), 0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT,
                         GL_NEAREST);
  drawToAll(target.id(), target.colours_);
}

}  // namespace lychnite::gpu
