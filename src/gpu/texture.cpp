#include "gpu/texture.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cassert>

#include "gpu/context_state.h"
#include "gpu/object_access.h"
#include "lychnite/base/error.h"

namespace lychnite::gpu {
namespace {

struct FormatInfo {
  GLenum internal, transfer, type;
  int channels;
  size_t bytes;
};

FormatInfo infoOf(Format format) {
  switch (format) {
    case Format::kRgba8:
      return {GL_RGBA8, GL_RGBA, GL_FLOAT, 4, 4};
    case Format::kR16f:
      return {GL_R16F, GL_RED, GL_FLOAT, 1, 2};
    case Format::kRg16f:
      return {GL_RG16F, GL_RG, GL_FLOAT, 2, 4};
    case Format::kRgba16f:
      return {GL_RGBA16F, GL_RGBA, GL_FLOAT, 4, 8};
    case Format::kR32f:
      return {GL_R32F, GL_RED, GL_FLOAT, 1, 4};
    case Format::kRg32f:
      return {GL_RG32F, GL_RG, GL_FLOAT, 2, 8};
    case Format::kRgba32f:
      return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 4, 16};
    case Format::kR32ui:
      return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 1, 4};
    case Format::kDepth32f:
      return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 1, 4};
  }
  assert(false);
  return {};
}

GLint glFilter(Filter filter) {
  switch (filter) {
    case Filter::kNearest:
      return GL_NEAREST;
    case Filter::kLinear:
      return GL_LINEAR;
    case Filter::kNearestMipNearest:
      return GL_NEAREST_MIPMAP_NEAREST;
    case Filter::kLinearMipNearest:
      return GL_LINEAR_MIPMAP_NEAREST;
    case Filter::kLinearMipLinear:
      return GL_LINEAR_MIPMAP_LINEAR;
  }
  assert(false);
  return GL_NEAREST;
}

GLint glWrap(Wrap wrap) {
  switch (wrap) {
    case Wrap::kClampToEdge:
      return GL_CLAMP_TO_EDGE;
    case Wrap::kClampToBorder:
      return GL_CLAMP_TO_BORDER;
    case Wrap::kRepeat:
      return GL_REPEAT;
  }
  assert(false);
  return GL_CLAMP_TO_EDGE;
}

uint32_t createTexture(const TextureDesc& desc) {
  GLuint id = 0;
  glCreateTextures(desc.samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D, 1, &id);
  return id;
}

void deleteTexture(uint32_t id) {
  glDeleteTextures(1, &id);
}

std::string sizeText(const TextureDesc& desc) {
  std::string text = std::to_string(desc.width) + " x " + std::to_string(desc.height);
  if (desc.samples > 1) text += " with " + std::to_string(desc.samples) + " samples";
  return text;
}

/// The description with its 0 for "all levels" replaced; throws when the device has no such texture.
TextureDesc checked(TextureDesc desc) {
  assert(desc.width > 0 && desc.height > 0 && desc.samples > 0);
  const int largest = maxTextureSize();
  if (desc.width > largest || desc.height > largest || desc.samples > maxSamples())
    throw Error({.where = "texture '" + desc.label + "'",
                 .expected = "at most " + std::to_string(largest) + " x " + std::to_string(largest) +
                             " with " + std::to_string(maxSamples()) + " samples on this device",
                 .found = sizeText(desc),
                 .todo = ""},
                Error::Kind::kUsage);
  if (desc.levels == 0) desc.levels = fullLevels(desc.width, desc.height);
  assert(desc.levels <= fullLevels(desc.width, desc.height));
  assert(desc.samples == 1 || desc.levels == 1);
  return desc;
}

size_t bytesOf(const TextureDesc& desc) {
  size_t texels = 0;
  for (int level = 0; level < desc.levels; ++level)
    texels += static_cast<size_t>(std::max(1, desc.width >> level)) * std::max(1, desc.height >> level);
  return texels * texelBytes(desc.format) * desc.samples;
}

/// Reads a level in bands of at most 1 GiB: OpenGL counts the bytes of one transfer in an int.
void readRows(GLuint id, const FormatInfo& info, int level, int width, int height,
              std::span<std::byte> bytes) {
  const size_t rowBytes = bytes.size() / static_cast<size_t>(height);
  const int band =
      static_cast<int>(std::clamp<size_t>((size_t{1} << 30) / rowBytes, 1, static_cast<size_t>(height)));
  for (int y = 0; y < height; y += band) {
    const int rows = std::min(band, height - y);
    glGetTextureSubImage(id, level, 0, y, 0, width, rows, 1, info.transfer, info.type,
                         static_cast<GLsizei>(rowBytes * static_cast<size_t>(rows)),
                         bytes.data() + rowBytes * static_cast<size_t>(y));
  }
}

}  // namespace

uint32_t internalFormat(Format format) {
  return infoOf(format).internal;
}

int channels(Format format) {
  return infoOf(format).channels;
}

size_t texelBytes(Format format) {
  return infoOf(format).bytes;
}

int fullLevels(int width, int height) {
  return std::bit_width(static_cast<unsigned>(std::max({width, height, 1})));
}

uint32_t foreignName(const Texture& texture) {
  return ObjectAccess::id(texture);
}

Texture::Texture(const TextureDesc& desc)
    : Object(createTexture(desc), GL_TEXTURE, deleteTexture, desc.label), desc_(checked(desc)) {
  const GLenum internal = infoOf(desc_.format).internal;
  if (desc_.samples > 1)
    glTextureStorage2DMultisample(id(), desc_.samples, internal, desc_.width, desc_.height, GL_TRUE);
  else
    glTextureStorage2D(id(), desc_.levels, internal, desc_.width, desc_.height);
  GLint allocated = 0;
  glGetTextureParameteriv(id(), GL_TEXTURE_IMMUTABLE_FORMAT, &allocated);
  if (!allocated)
    throw Error({.where = "texture '" + desc_.label + "'",
                 .expected = sizeText(desc_) + " on the device",
                 .found = takeError(state()),
                 .todo = "choose a smaller size"},
                Error::Kind::kDevice);
  setBytes(bytesOf(desc_));
  if (desc_.samples > 1) return;
  setFilter(desc_.filter);
  setWrap(desc_.wrap, desc_.border);
}

int Texture::width(int level) const {
  return std::max(1, desc_.width >> level);
}
int Texture::height(int level) const {
  return std::max(1, desc_.height >> level);
}

void Texture::setFilter(Filter filter) {
  desc_.filter = filter;
  const bool smooth = filter != Filter::kNearest && filter != Filter::kNearestMipNearest;
  glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER, glFilter(filter));
  glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, smooth ? GL_LINEAR : GL_NEAREST);
}

void Texture::setWrap(Wrap wrap, const std::array<float, 4>& border) {
  desc_.wrap = wrap;
  desc_.border = border;
  glTextureParameteri(id(), GL_TEXTURE_WRAP_S, glWrap(wrap));
  glTextureParameteri(id(), GL_TEXTURE_WRAP_T, glWrap(wrap));
  glTextureParameterfv(id(), GL_TEXTURE_BORDER_COLOR, border.data());
}

void Texture::setLevelRange(int first, int last) {
  assert(0 <= first && first <= last && last < desc_.levels);
  glTextureParameteri(id(), GL_TEXTURE_BASE_LEVEL, first);
  glTextureParameteri(id(), GL_TEXTURE_MAX_LEVEL, last);
}

void Texture::upload(std::span<const float> values, int level) {
  const FormatInfo info = infoOf(desc_.format);
  assert(info.type == GL_FLOAT && desc_.samples == 1 && level < desc_.levels);
  assert(values.size() == static_cast<size_t>(width(level)) * height(level) * info.channels);
  glTextureSubImage2D(id(), level, 0, 0, width(level), height(level), info.transfer, GL_FLOAT, values.data());
}

void Texture::upload(std::span<const uint32_t> values, int level) {
  assert(desc_.format == Format::kR32ui && desc_.samples == 1 && level < desc_.levels);
  assert(values.size() == static_cast<size_t>(width(level)) * height(level));
  glTextureSubImage2D(id(), level, 0, 0, width(level), height(level), GL_RED_INTEGER, GL_UNSIGNED_INT,
                      values.data());
}

std::vector<float> Texture::download(int level) const {
  const FormatInfo info = infoOf(desc_.format);
  assert(info.type == GL_FLOAT && desc_.samples == 1 && level < desc_.levels);
  std::vector<float> values(static_cast<size_t>(width(level)) * height(level) * info.channels);
  readRows(id(), info, level, width(level), height(level), std::as_writable_bytes(std::span(values)));
  return values;
}

std::vector<uint32_t> Texture::downloadUint(int level) const {
  assert(desc_.format == Format::kR32ui && desc_.samples == 1 && level < desc_.levels);
  std::vector<uint32_t> values(static_cast<size_t>(width(level)) * height(level));
  readRows(id(), infoOf(desc_.format), level, width(level), height(level),
           std::as_writable_bytes(std::span(values)));
  return values;
}

void Texture::generateMipmaps() {
  assert(desc_.format != Format::kR32ui && desc_.format != Format::kDepth32f && desc_.samples == 1);
  glGenerateTextureMipmap(id());
}

}  // namespace lychnite::gpu
