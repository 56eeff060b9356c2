#include "gpu/shader_source.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include "lychnite/base/error.h"

namespace lychnite::gpu {
namespace {

namespace fs = std::filesystem;

std::string header(GlslDialect dialect, const ShaderDefines& defines) {
  std::string text;
  if (dialect == GlslDialect::kDesktop450) {
    text = "#version 450 core\n";
  } else {
    text =
        "#version 300 es\n"
        "#define LYCHNITE_ES 1\n"
        "precision highp float;\n"
        "precision highp int;\n"
        "precision highp sampler2D;\n"
        "precision highp usampler2D;\n";
  }
  text += "#define LYCHNITE_GLSL 1\n#define OUT(T) out T\n#define INOUT(T) inout T\n";
  for (const auto& [name, value] : defines) text += "#define " + name + " " + value + "\n";
  return text;
}

/// `text` without what stands at its beginning: any number of blanks and then `word`. Nothing when it begins
/// otherwise.
std::optional<std::string_view> after(std::string_view text, std::string_view word) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  return text.starts_with(word) ? std::optional(text.substr(word.size())) : std::nullopt;
}

/// The quoted path when the line is an include.
std::string includedFile(std::string_view line) {
  std::optional<std::string_view> rest = line;
  for (const char* word : {"#", "include", "\""})
    if (rest) rest = after(*rest, word);
  const size_t end = rest ? rest->find('"') : std::string_view::npos;
  return end == std::string_view::npos ? "" : std::string(rest->substr(0, end));
}

/// Puts files one into another and remembers which have been seen.
class Assembler {
 public:
  Assembler(const fs::path& root, ShaderSource& source) : root_(root), source_(source) {}

  /// `from` names the including line, for the error message.
  void add(const std::string& file, const std::string& from) {
    std::ifstream in(root_ / file);
    if (!in || !fs::is_regular_file(root_ / file))
      throw Error({.where = from,
                   .expected = "a readable shader file",
                   .found = "'" + (root_ / file).string() + "'",
                   .todo = ""},
                  Error::Kind::kDevice);
    const int index = static_cast<int>(source_.files.size());
    source_.files.push_back(file);
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
      const std::string included = includedFile(line);
      if (included.empty()) {
        source_.text += line + "\n";
        source_.lines.push_back({index, number});
      } else if (!seen(included)) {
        add(included, file + ":" + std::to_string(number));
      }
    }
  }

 private:
  bool seen(const std::string& file) const {
    for (const std::string& known : source_.files)
      if (fs::path(known).lexically_normal() == fs::path(file).lexically_normal()) return true;
    return false;
  }

  const fs::path& root_;
  ShaderSource& source_;
};

/// "file:line" of a line of the text, from 1.
std::string placeOf(const ShaderSource& source, size_t line) {
  if (line == 0 || line > source.lines.size()) return source.files.front();
  const ShaderSource::Place& place = source.lines[line - 1];
  const std::string& file = source.files[place.file];
  return place.line > 0 ? file + ":" + std::to_string(place.line) : file + " (its defines)";
}

/// A driver's message: the line of the text, from 1, and what is wrong there.
struct Found {
  size_t line = 0;
  std::string_view words;
};

/// Where `text` begins as `pattern`, in which '#' stands for a number and '@' for the line's.
std::optional<Found> beginsAs(std::string_view pattern, std::string_view text) {
  Found found;
  for (const char sign : pattern) {
    if (sign == '#' || sign == '@') {
      const size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
      if (digits == 0 || digits > 9) return {};
      if (sign == '@') found.line = std::stoul(std::string(text.substr(0, digits)));
      text.remove_prefix(digits);
    } else {
      if (!text.starts_with(sign)) return {};
      text.remove_prefix(1);
    }
  }
  found.words = text;
  return found;
}

bool parseMessage(std::string_view line, const ShaderSource& source, ShaderMessage& message) {
  // Mesa's two, NVIDIA's and ANGLE's.
  for (const char* pattern :
       {"#:@(#): error: ", "#:@(#): preprocessor error: ", "#(@) : error ", "ERROR: #:@: "}) {
    for (size_t from = 0; from < line.size(); ++from) {
      const auto found = beginsAs(pattern, line.substr(from));
      if (!found) continue;
      message = {placeOf(source, found->line), std::string(found->words)};
      return true;
    }
  }
  return false;
}

fs::path besideProgram() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path() : (program.parent_path() / "../share/lychnite/shaders").lexically_normal();
}

}  // namespace

ShaderSource assembleShader(const fs::path& root, const std::string& file, GlslDialect dialect,
                            const ShaderDefines& defines) {
  ShaderSource source;
  source.text = header(dialect, defines);
  source.lines.resize(static_cast<size_t>(std::count(source.text.begin(), source.text.end(), '\n')));
  Assembler(root, source).add(file, "shaders");
  return source;
}

ShaderMessage firstError(const std::string& log, const ShaderSource& source) {
  ShaderMessage message;
  std::istringstream lines(log);
  std::string fallback;
  for (std::string line; std::getline(lines, line);) {
    if (parseMessage(line, source, message)) return message;
    if (fallback.empty() && line.find_first_not_of(" \t\r") != std::string::npos) fallback = line;
  }
  return {source.files.front(), fallback.empty() ? "an error without a message" : fallback};
}

fs::path findShaderDir() {
  const char* chosen = std::getenv("LYCHNITE_SHADER_DIR");
  std::vector<fs::path> places{besideProgram(), LYCHNITE_BUILD_SHADER_DIR, LYCHNITE_INSTALL_SHADER_DIR};
  // A folder that was asked for by name and is not there is a mistake to report, not to paper over.
  if (chosen && *chosen) places = {chosen};
  std::string looked;
  for (const fs::path& place : places) {
    std::error_code error;
    if (fs::is_directory(place / "pass", error)) return place;
    looked += (looked.empty() ? "" : ", ") + place.string();
  }
  throw Error({.where = "shaders",
               .expected = "a folder with lib/ and pass/",
               .found = "none at " + looked,
               .todo = "reinstall, or set LYCHNITE_SHADER_DIR"},
              Error::Kind::kDevice);
}

}  // namespace lychnite::gpu
