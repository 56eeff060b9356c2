#pragma once

#include <imgui.h>

#include <array>
#include <map>
#include <string>

#include "area.h"
#include "lychnite/base/vec.h"
#include "window.h"

namespace lychnite::viewer {

/// Dear ImGui in our window: font, theme, input, and the pieces that panels are made of.
class Ui {
 public:
  explicit Ui(Window& window);
  ~Ui();
  Ui(const Ui&) = delete;
  Ui& operator=(const Ui&) = delete;

  void feed(const InputEvent& event);
  /// Between begin() and end() ImGui's functions may be called; end() draws on the current framebuffer.
  void begin(double seconds);
  void end();

  double scale() const { return scale_; }
  /// The mouse or the keyboard is busy with a control.
  bool wantsMouse() const;
  bool wantsKeys() const;
  /// A control is held or typed into.
  bool busy() const;

  /// Gives the last control a name that scripts find it by.
  void mark(const std::string& name);
  void mark(const std::string& name, const Area& area);
  const std::map<std::string, Area>& marks() const { return marks_; }

  /// A label on the left of the panel; the next control fills the rest of the line. `help` is shown when the
  /// mouse rests on the label.
  void label(const char* text, const char* help);
  /// "?": the same for what has no label.
  static void help(const char* text);
  bool slider(const char* text, const char* help, double& value, double low, double high, const char* format,
              bool logarithmic = false);
  bool slider(const char* text, const char* help, int& value, int low, int high);
  /// Three numbers of one sort, each of a channel.
  bool sliders(const char* text, const char* help, Rgb& value, double low, double high, const char* format,
               bool logarithmic = true);
  /// A colour in linear values.
  bool colour(const char* text, const char* help, Rgb& value);
  bool choice(const char* text, const char* help, int& value, const std::vector<std::string>& names);
  bool check(const char* text, const char* help, bool& value);
  bool button(const char* text, const char* help, bool enabled = true);
  /// Small grey text, wrapped.
  void note(const std::string& text);

 private:
  void setFont();
  void setTheme();

  Window& window_;
  double scale_ = 1;
  std::map<std::string, Area> marks_;
  std::array<bool, 3> held_{}, pressed_{};
};

/// "Free path, mm" -> "free-path".
std::string markName(const std::string& label);

inline ImVec2 toIm(const glm::dvec2& p) {
  return {float(p.x), float(p.y)};
}
inline glm::dvec2 fromIm(const ImVec2& p) {
  return {double(p.x), double(p.y)};
}

}  // namespace lychnite::viewer
