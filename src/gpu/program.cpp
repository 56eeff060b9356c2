#include "gpu/program.h"

#include <epoxy/gl.h>

#include <glm/gtc/type_ptr.hpp>
#include <memory>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/object_access.h"
#include "gpu/texture.h"
#include "lychnite/base/error.h"

namespace lychnite::gpu {
namespace {

/// Frees a shader object once the program is linked or compiling has failed.
struct Shader {
  explicit Shader(GLenum stage) : id(glCreateShader(stage)) {}
  ~Shader() { glDeleteShader(id); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  GLuint id;
};

[[noreturn]] void throwBadShader(const ShaderMessage& message, const std::string& label) {
  throw Error({.where = message.where,
               .expected = "a shader this driver compiles (program '" + label + "')",
               .found = message.text,
               .todo = ""},
              Error::Kind::kDevice);
}

void compile(const Shader& shader, const ShaderSource& source, const std::string& label) {
  const char* text = source.text.c_str();
  glShaderSource(shader.id, 1, &text, nullptr);
  glCompileShader(shader.id);
  GLint compiled = 0, length = 0;
  glGetShaderiv(shader.id, GL_COMPILE_STATUS, &compiled);
  if (compiled) return;
  glGetShaderiv(shader.id, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<size_t>(length) + 1, '\0');
  glGetShaderInfoLog(shader.id, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throwBadShader(firstError(log.c_str(), source), label);
}

/// The first line of a linker's log that says something.
std::string linkMessage(const std::string& log) {
  const size_t first = log.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "a link error without a message";
  return log.substr(first, log.find('\n', first) - first);
}

void link(GLuint program, const ProgramDesc& desc) {
  glLinkProgram(program);
  GLint linked = 0, length = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<size_t>(length) + 1, '\0');
  glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  const std::string files = desc.compute.empty() ? desc.vertex + " + " + desc.fragment : desc.compute;
  throwBadShader({files, linkMessage(log.c_str())}, desc.label);
}

void deleteProgram(uint32_t id) {
  glDeleteProgram(id);
}

bool isSampler(GLenum type) {
  switch (type) {
    case GL_SAMPLER_2D:
    case GL_SAMPLER_2D_SHADOW:
    case GL_SAMPLER_2D_MULTISAMPLE:
    case GL_UNSIGNED_INT_SAMPLER_2D:
    case GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE:
      return true;
    default:
      return false;
  }
}

}  // namespace

Program::Program(const ProgramDesc& desc) : Object(glCreateProgram(), GL_PROGRAM, deleteProgram, desc.label) {
  const std::filesystem::path root = desc.root.empty() ? findShaderDir() : desc.root;
  std::vector<std::unique_ptr<Shader>> shaders;
  const auto add = [&](GLenum stage, const std::string& file) {
    shaders.push_back(std::make_unique<Shader>(stage));
    compile(*shaders.back(), assembleShader(root, file, GlslDialect::kDesktop450, desc.defines), desc.label);
    glAttachShader(id(), shaders.back()->id);
  };
  if (desc.compute.empty()) {
    add(GL_VERTEX_SHADER, desc.vertex);
    add(GL_FRAGMENT_SHADER, desc.fragment);
  } else {
    add(GL_COMPUTE_SHADER, desc.compute);
  }
  link(id(), desc);
  for (const auto& shader : shaders) glDetachShader(id(), shader->id);
  readUniforms();
  readBlocks();
  readStorage();
}

void Program::readUniforms() {
  GLint count = 0, longest = 0;
  glGetProgramiv(id(), GL_ACTIVE_UNIFORMS, &count);
  glGetProgramiv(id(), GL_ACTIVE_UNIFORM_MAX_LENGTH, &longest);
  std::vector<char> buffer(static_cast<size_t>(longest) + 1);
  for (GLint i = 0; i < count; ++i) {
    GLint size = 0;
    GLenum type = 0;
    glGetActiveUniform(id(), i, static_cast<GLsizei>(buffer.size()), nullptr, &size, &type, buffer.data());
    std::string name(buffer.data());
    const int place = glGetUniformLocation(id(), name.c_str());
    if (place < 0) continue;  // a member of a block
    if (name.ends_with("[0]")) name.resize(name.size() - 3);
    locations_[name] = place;
    if (type == GL_IMAGE_2D) {
      const int number = static_cast<int>(images_.size());
      glProgramUniform1i(id(), place, number);
      images_[name] = {number, 0, 0};
    }
    if (!isSampler(type)) continue;
    const int unit = static_cast<int>(units_.size());
    glProgramUniform1i(id(), place, unit);
    units_[name] = {unit, 0};
  }
}

void Program::readBlocks() {
  GLint count = 0, longest = 0;
  glGetProgramiv(id(), GL_ACTIVE_UNIFORM_BLOCKS, &count);
  glGetProgramiv(id(), GL_ACTIVE_UNIFORM_BLOCK_MAX_NAME_LENGTH, &longest);
  std::vector<char> buffer(static_cast<size_t>(longest) + 1);
  for (GLint i = 0; i < count; ++i) {
    glGetActiveUniformBlockName(id(), i, static_cast<GLsizei>(buffer.size()), nullptr, buffer.data());
    glUniformBlockBinding(id(), i, i);
    blocks_[buffer.data()] = {i, 0};
  }
}

void Program::readStorage() {
  GLint count = 0, longest = 0;
  glGetProgramInterfaceiv(id(), GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &count);
  glGetProgramInterfaceiv(id(), GL_SHADER_STORAGE_BLOCK, GL_MAX_NAME_LENGTH, &longest);
  std::vector<char> buffer(static_cast<size_t>(longest) + 1);
  for (GLint i = 0; i < count; ++i) {
    const auto index = static_cast<GLuint>(i);
    glGetProgramResourceName(id(), GL_SHADER_STORAGE_BLOCK, index, static_cast<GLsizei>(buffer.size()),
                             nullptr, buffer.data());
    glShaderStorageBlockBinding(id(), index, index);
    storage_[buffer.data()] = {i, 0};
  }
}

bool Program::has(std::string_view uniform) const {
  return locations_.find(uniform) != locations_.end() || blocks_.find(uniform) != blocks_.end();
}

int Program::location(std::string_view uniform) const {
  // OpenGL ignores what is set at location -1.
  const auto found = locations_.find(uniform);
  return found == locations_.end() ? -1 : found->second;
}

void Program::set(std::string_view uniform, int value) {
  glProgramUniform1i(id(), location(uniform), value);
}

void Program::set(std::string_view uniform, uint32_t value) {
  glProgramUniform1ui(id(), location(uniform), value);
}

void Program::set(std::string_view uniform, float value) {
  glProgramUniform1f(id(), location(uniform), value);
}

void Program::set(std::string_view uniform, const glm::ivec2& value) {
  glProgramUniform2i(id(), location(uniform), value.x, value.y);
}

void Program::set(std::string_view uniform, const glm::vec2& value) {
  set(uniform, std::span(&value, 1));
}

void Program::set(std::string_view uniform, const glm::vec3& value) {
  set(uniform, std::span(&value, 1));
}

void Program::set(std::string_view uniform, const glm::vec4& value) {
  set(uniform, std::span(&value, 1));
}

void Program::set(std::string_view uniform, const glm::mat3& value) {
  glProgramUniformMatrix3fv(id(), location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

void Program::set(std::string_view uniform, const glm::mat4& value) {
  glProgramUniformMatrix4fv(id(), location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

void Program::set(std::string_view uniform, std::span<const float> values) {
  glProgramUniform1fv(id(), location(uniform), static_cast<GLsizei>(values.size()), values.data());
}

void Program::set(std::string_view uniform, std::span<const glm::vec2> values) {
  if (values.empty()) return;
  glProgramUniform2fv(id(), location(uniform), static_cast<GLsizei>(values.size()),
                      glm::value_ptr(values[0]));
}

void Program::set(std::string_view uniform, std::span<const glm::vec3> values) {
  if (values.empty()) return;
  glProgramUniform3fv(id(), location(uniform), static_cast<GLsizei>(values.size()),
                      glm::value_ptr(values[0]));
}

void Program::set(std::string_view uniform, std::span<const glm::vec4> values) {
  if (values.empty()) return;
  glProgramUniform4fv(id(), location(uniform), static_cast<GLsizei>(values.size()),
                      glm::value_ptr(values[0]));
}

void Program::setTexture(std::string_view sampler, const Texture& texture) {
  const auto found = units_.find(sampler);
  if (found != units_.end()) found->second.object = ObjectAccess::id(texture);
}

void Program::setImage(std::string_view image, const Texture& texture) {
  const auto found = images_.find(image);
  if (found == images_.end()) return;
  found->second.object = ObjectAccess::id(texture);
  found->second.format = internalFormat(texture.format());
}

void Program::setBlock(std::string_view block, const Buffer& buffer) {
  const auto found = blocks_.find(block);
  if (found != blocks_.end()) found->second.object = ObjectAccess::id(buffer);
}

void Program::setStorage(std::string_view block, const Buffer& buffer) {
  const auto found = storage_.find(block);
  if (found != storage_.end()) found->second.object = ObjectAccess::id(buffer);
}

void Program::bind() const {
  glUseProgram(id());
  for (const auto& [name, slot] : units_) glBindTextureUnit(slot.number, slot.object);
  for (const auto& [name, slot] : blocks_) glBindBufferBase(GL_UNIFORM_BUFFER, slot.number, slot.object);
  for (const auto& [name, image] : images_)
    glBindImageTexture(static_cast<GLuint>(image.number), image.object, 0, GL_FALSE, 0, GL_WRITE_ONLY,
                       image.format);
  for (const auto& [name, slot] : storage_)
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(slot.number), slot.object);
}

}  // namespace lychnite::gpu
