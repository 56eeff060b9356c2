#include "window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <glm/common.hpp>
#include <map>
#include <utility>

#include "lychnite/base/error.h"

namespace lychnite::viewer {
namespace {

std::string lastProblem;

void onError(int, const char* text) {
  lastProblem = text;
}

[[noreturn]] void refuse(const std::string& expected, const std::string& todo) {
  throw Error({.where = "view",
               .expected = expected,
               .found = lastProblem.empty() ? "none" : lastProblem,
               .todo = todo},
              Error::Kind::kDevice);
}

void setHints(const WindowOptions& options) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
  // EGL everywhere, so that the window's context is of the kind that gpu/ works with.
  glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, options.scale ? GLFW_FALSE : GLFW_TRUE);
}

KeyChord modifiersOf(int mods) {
  return {.key = "",
          .ctrl = (mods & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) != 0,
          .shift = (mods & GLFW_MOD_SHIFT) != 0,
          .alt = (mods & GLFW_MOD_ALT) != 0};
}

}  // namespace

/// GLFW's callbacks.
struct WindowEvents {
  static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }
  static void add(GLFWwindow* window, InputEvent event) { of(window).events_.push_back(std::move(event)); }

  static void move(GLFWwindow* window, double x, double y) {
    const Window& self = of(window);
    const glm::dvec2 size = glm::max(self.windowSize(), glm::ivec2(1));
    add(window, {.kind = InputEvent::Kind::kMove, .at = glm::dvec2(x, y) * glm::dvec2(self.pixels()) / size});
  }
  static void button(GLFWwindow* window, int which, int action, int) {
    if (which <= GLFW_MOUSE_BUTTON_MIDDLE)
      add(window, {.kind = InputEvent::Kind::kButton, .button = which, .down = action == GLFW_PRESS});
  }
  static void scroll(GLFWwindow* window, double, double y) {
    add(window, {.kind = InputEvent::Kind::kScroll, .notches = y});
  }
  static void key(GLFWwindow* window, int which, int, int action, int mods) {
    if (which == GLFW_KEY_UNKNOWN) return;
    add(window, {.kind = InputEvent::Kind::kKey,
                 .down = action != GLFW_RELEASE,
                 .key = which,
                 .modifiers = modifiersOf(mods)});
  }
  static void text(GLFWwindow* window, unsigned codePoint) {
    add(window, {.kind = InputEvent::Kind::kText, .codePoint = codePoint});
  }
  static void drop(GLFWwindow* window, int count, const char** paths) {
    InputEvent event{.kind = InputEvent::Kind::kDrop};
    event.files.assign(paths, paths + count);
    add(window, std::move(event));
  }
  static void focus(GLFWwindow* window, int gained) {
    add(window, {.kind = InputEvent::Kind::kFocus, .down = gained == GLFW_TRUE});
  }
  static void install(GLFWwindow* window, Window* self) {
    glfwSetWindowUserPointer(window, self);
    glfwSetCursorPosCallback(window, move);
    glfwSetMouseButtonCallback(window, button);
    glfwSetScrollCallback(window, scroll);
    glfwSetKeyCallback(window, key);
    glfwSetCharCallback(window, text);
    glfwSetDropCallback(window, drop);
    glfwSetWindowFocusCallback(window, focus);
  }
};

Window::Window(const WindowOptions& options) : fixedScale_(options.scale) {
  glfwSetErrorCallback(onError);
  if (!glfwInit())
    refuse("a display (X11 or Wayland) to open a window on",
           "set DISPLAY, or write a picture with `lychnite render`");
  setHints(options);
  const double scale = options.scale.value_or(1);
  window_ =
      glfwCreateWindow(int(options.width * scale), int(options.height * scale), "Lychnite", nullptr, nullptr);
  if (!window_) {
    const std::string problem = lastProblem;
    glfwTerminate();
    lastProblem = problem;
    refuse("a window with OpenGL 4.5 core (through EGL)",
           "install or update the graphics driver, or write a picture with `lychnite render --device cpu`");
  }
  WindowEvents::install(window_, this);
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowSizeLimits(window_, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
  for (const int shape : {GLFW_ARROW_CURSOR, GLFW_IBEAM_CURSOR, GLFW_HRESIZE_CURSOR, GLFW_HAND_CURSOR})
    cursors_.push_back(glfwCreateStandardCursor(shape));
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

glm::ivec2 Window::pixels() const {
  glm::ivec2 size(0);
  glfwGetFramebufferSize(window_, &size.x, &size.y);
  return size;
}

glm::ivec2 Window::windowSize() const {
  glm::ivec2 size(0);
  glfwGetWindowSize(window_, &size.x, &size.y);
  return size;
}

double Window::scale() const {
  if (fixedScale_) return *fixedScale_;
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return x > 0 ? double(x) : 1;
}

bool Window::closing() const {
  return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

bool Window::visible() const {
  const glm::ivec2 size = pixels();
  return size.x > 0 && size.y > 0 && !glfwGetWindowAttrib(window_, GLFW_ICONIFIED);
}

void Window::setTitle(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

void Window::resize(glm::ivec2 size) {
  glfwSetWindowSize(window_, size.x, size.y);
}

void Window::minimise() {
  glfwIconifyWindow(window_);
}

void Window::hide() {
  glfwHideWindow(window_);
}

void Window::restore() {
  glfwRestoreWindow(window_);
}

void Window::swap() {
  glfwSwapBuffers(window_);
}

std::vector<InputEvent> Window::events(double wait) {
  if (wait > 0)
    glfwWaitEventsTimeout(wait);
  else
    glfwPollEvents();
  return std::exchange(events_, {});
}

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(window_);
  return text ? text : "";
}

void Window::setClipboard(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

void Window::setCursor(Cursor cursor) {
  if (cursor == cursor_) return;
  cursor_ = cursor;
  glfwSetCursor(window_, cursors_[size_t(cursor)]);
}

int keyNumber(const std::string& name) {
  static const std::map<std::string, int> kNamed{
      {"escape", GLFW_KEY_ESCAPE},  {"enter", GLFW_KEY_ENTER},
      {"tab", GLFW_KEY_TAB},        {"backspace", GLFW_KEY_BACKSPACE},
      {"delete", GLFW_KEY_DELETE},  {"space", GLFW_KEY_SPACE},
      {"left", GLFW_KEY_LEFT},      {"right", GLFW_KEY_RIGHT},
      {"up", GLFW_KEY_UP},          {"down", GLFW_KEY_DOWN},
      {"home", GLFW_KEY_HOME},      {"end", GLFW_KEY_END},
      {"[", GLFW_KEY_LEFT_BRACKET}, {"]", GLFW_KEY_RIGHT_BRACKET},
      {"plus", GLFW_KEY_KP_ADD},    {"minus", GLFW_KEY_MINUS},
      {"f1", GLFW_KEY_F1}};
  if (const auto found = kNamed.find(name); found != kNamed.end()) return found->second;
  const char c = name.empty() ? '\0' : name[0];
  return c >= 'a' && c <= 'z' ? GLFW_KEY_A + (c - 'a') : GLFW_KEY_0 + (c - '0');
}

}  // namespace lychnite::viewer
