#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace lychnite::gpu {

/// The languages one shader text is compiled as.
enum class GlslDialect { kDesktop450, kEs300 };

/// Constants of a program variant, `#define first second`.
using ShaderDefines = std::vector<std::pair<std::string, std::string>>;

/// A whole translation unit: header, defines, then the file with its includes put in place. It has no #line
/// directives: drivers disagree about them (Mesa 22 forgets the file's number in most messages), so the
/// places are found by counting lines.
struct ShaderSource {
  struct Place {
    int file = 0;  ///< index into files
    int line = 0;  ///< from 1; 0 for what was prepended
  };
  std::string text;
  std::vector<std::string> files;  ///< the entry file, then what it includes
  std::vector<Place> lines;        ///< where line i + 1 of the text comes from
};

/// Reads `file` (relative to `root`) and every `#include "path"` below it (relative to `root` too, each once,
/// the first time it is met; includes are expanded even inside a false #if). What is prepended: the #version
/// line, for ES the precision statements, LYCHNITE_GLSL and (ES only) LYCHNITE_ES, the parameter macros
/// OUT(T) and INOUT(T) that shaders/lib uses, and the defines. Throws Error at "file:line" when a file cannot
/// be read.
ShaderSource assembleShader(const std::filesystem::path& root, const std::string& file, GlslDialect dialect,
                            const ShaderDefines& defines = {});

/// One message of a compiler's log, its place translated to a file of the source.
struct ShaderMessage {
  std::string where;  ///< "lib/x.glsl:12", or the entry file alone when the log names no line
  std::string text;   ///< the driver's line without the place
};

/// The first error of the log a driver gave for `source`; understands Mesa ("0:12(3): error: ..."), NVIDIA
/// ("0(12) : error ...") and ANGLE ("ERROR: 0:12: ..."). A line it does not understand is kept as it is.
ShaderMessage firstError(const std::string& log, const ShaderSource& source);

/// The folder that holds lib/ and pass/: $LYCHNITE_SHADER_DIR, else ../share/lychnite/shaders beside the
/// running program, else the source tree this was built from, else the install prefix. Throws Error that
/// names the places.
std::filesystem::path findShaderDir();

}  // namespace lychnite::gpu
