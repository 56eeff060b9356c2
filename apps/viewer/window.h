#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lychnite/app/input_script.h"

struct GLFWcursor;
struct GLFWwindow;

namespace lychnite::viewer {

/// What a person (or a script) did. Places are pixels of the framebuffer from its upper left corner.
struct InputEvent {
  enum class Kind { kMove, kButton, kScroll, kKey, kText, kDrop, kFocus };
  Kind kind = Kind::kMove;
  glm::dvec2 at{0};        ///< kMove
  int button = 0;          ///< kButton: 0 left, 1 right, 2 middle
  bool down = false;       ///< kButton, kKey; kFocus: gained
  double notches = 0;      ///< kScroll
  int key = 0;             ///< kKey: GLFW's number
  KeyChord modifiers{};    ///< kKey: its ctrl, shift, alt
  unsigned codePoint = 0;  ///< kText
  std::vector<std::string> files{};
};

struct WindowOptions {
  int width = 1280, height = 720;  ///< at scale 1
  std::optional<double> scale;     ///< of everything in the window; empty: the display's
  bool debug = false;              ///< a debug context
};

/// A window with an OpenGL 4.5 core context that is current on this thread. Throws Error (Kind::kDevice)
/// where there is no display or no such driver.
class Window {
 public:
  explicit Window(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  glm::ivec2 pixels() const;      ///< of the framebuffer; 0 while minimised
  glm::ivec2 windowSize() const;  ///< in screen coordinates
  double scale() const;           ///< pixels of the framebuffer to a pixel at scale 1
  bool closing() const;
  bool visible() const;
  void setTitle(const std::string& title);
  void resize(glm::ivec2 size);
  void minimise();
  void hide();
  void restore();
  void swap();
  /// What happened since the last call; waits for something to happen, at most so many seconds.
  std::vector<InputEvent> events(double wait);

  std::string clipboard() const;
  void setClipboard(const std::string& text);
  enum class Cursor { kArrow, kText, kHorizontal, kHand };
  void setCursor(Cursor cursor);

 private:
  friend struct WindowEvents;
  GLFWwindow* window_ = nullptr;
  std::optional<double> fixedScale_;
  std::vector<InputEvent> events_;
  std::vector<GLFWcursor*> cursors_;
  Cursor cursor_ = Cursor::kArrow;
};

/// GLFW's number of a key as scripts name it.
int keyNumber(const std::string& name);

}  // namespace lychnite::viewer
