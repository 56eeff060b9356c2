#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace lychnite {

/// A place in the window: pixels at scale 1 from its upper left corner, or a share (0 to 1, from the upper
/// left) of the control of that name.
struct ScriptPlace {
  std::string control;  ///< empty: `at` is in pixels
  glm::dvec2 at{0.5};
};

/// A key with its modifiers, as in "ctrl+shift+z".
struct KeyChord {
  std::string key;  ///< lower case: a letter, a digit, "[", "escape", "enter", ...
  bool ctrl = false, shift = false, alt = false;
  bool operator==(const KeyChord&) const = default;
};
/// Throws Error (Kind::kUsage).
KeyChord parseChord(std::string_view text, std::string_view where);
/// Every key that a chord may name beside letters and digits.
const std::vector<std::string>& namedKeys();

/// One line of a script.
struct ScriptStep {
  enum class Kind {
    kWaitFrames,  ///< count
    kWaitRest,    ///< until the picture is whole and nothing is loading or being written
    kWaitNoise,   ///< until the walk's noise is at most `number`
    kMove,        ///< to
    kPress,       ///< button
    kRelease,     ///< button
    kClick,       ///< to, button
    kDrag,        ///< from, to, button, in `count` frames
    kScroll,      ///< number: notches, away from the person above zero
    kKey,         ///< chord
    kType,        ///< text
    kDrop,        ///< texts: files
    kResize,      ///< to.at: the window's new size in screen coordinates
    kMinimise,
    kRestore,
    kScreenshot,  ///< text: the PNG to write
    kQuit
  };
  Kind kind = Kind::kQuit;
  int line = 0;  ///< of the script, from 1
  ScriptPlace from, to;
  int button = 0;  ///< 0 left, 1 right, 2 middle
  int count = 0;
  double number = 0;
  KeyChord chord;
  std::string text;
  std::vector<std::string> texts;
};

/// Reads a script (docs/user/viewer.md). Throws Error at "where:line".
std::vector<ScriptStep> parseScript(std::string_view text, std::string_view where);

}  // namespace lychnite
