#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "gpu/object.h"
#include "gpu/shader_source.h"

namespace lychnite::gpu {

class Buffer;
class Texture;

struct ProgramDesc {
  std::string label{};
  std::string vertex{}, fragment{};  ///< files below the shader folder, e.g. "pass/geometry.vert"
  std::string compute{};             ///< the same; instead of the two others
  ShaderDefines defines{};           ///< for all stages
  std::filesystem::path root{};      ///< the shader folder; empty: findShaderDir()
};

/// A vertex and a fragment shader, or a compute shader, linked. Throws Error (kDevice) with the file and line
/// of the first mistake, also inside an included file. Uniforms are set by name at any time; a name the
/// program does not have (or the compiler removed) is ignored. A wrong type makes the driver report an error,
/// see Context::checkErrors().
class Program : public Object {
 public:
  explicit Program(const ProgramDesc& desc);

  bool has(std::string_view uniform) const;

  void set(std::string_view uniform, int value);
  void set(std::string_view uniform, uint32_t value);
  void set(std::string_view uniform, float value);
  void set(std::string_view uniform, double value) { set(uniform, static_cast<float>(value)); }
  void set(std::string_view uniform, bool value) { set(uniform, value ? 1 : 0); }
  void set(std::string_view uniform, const glm::ivec2& value);
  void set(std::string_view uniform, const glm::vec2& value);
  void set(std::string_view uniform, const glm::vec3& value);
  void set(std::string_view uniform, const glm::vec4& value);
  void set(std::string_view uniform, const glm::mat3& value);
  void set(std::string_view uniform, const glm::mat4& value);
  /// Arrays, from element 0 on; `uniform` without brackets.
  void set(std::string_view uniform, std::span<const float> values);
  void set(std::string_view uniform, std::span<const glm::vec2> values);
  void set(std::string_view uniform, std::span<const glm::vec3> values);
  void set(std::string_view uniform, std::span<const glm::vec4> values);

  /// What the sampler reads from the next draw on. The texture must live until then; the program keeps its
  /// own numbering of texture units.
  void setTexture(std::string_view sampler, const Texture& texture);
  /// The texture's first level, which must be of 4 or 16 bytes a texel as the shader declares it, for a
  /// shader to write to, likewise.
  void setImage(std::string_view image, const Texture& texture);
  /// The uniform block's storage (std140), likewise.
  void setBlock(std::string_view block, const Buffer& buffer);
  /// The shader storage block's memory (std430), likewise.
  void setStorage(std::string_view block, const Buffer& buffer);

 private:
  friend struct ProgramAccess;
  /// A texture unit or block binding and what is bound there.
  struct Slot {
    int number = 0;
    uint32_t object = 0;
  };
  struct Image {
    int number = 0;
    uint32_t object = 0, format = 0;
  };
  int location(std::string_view uniform) const;
  void readUniforms();
  void readBlocks();
  void readStorage();
  void bind() const;

  std::map<std::string, int, std::less<>> locations_;
  std::map<std::string, Slot, std::less<>> units_;
  std::map<std::string, Image, std::less<>> images_;
  std::map<std::string, Slot, std::less<>> blocks_;
  std::map<std::string, Slot, std::less<>> storage_;
};

}  // namespace lychnite::gpu
