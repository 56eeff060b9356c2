#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "lychnite/app/input_script.h"
#include "ui.h"
#include "window.h"

namespace lychnite::viewer {

/// What a script can ask of the viewer beside input.
struct PlayerHost {
  std::function<bool()> atRest;   ///< the picture is whole, nothing loads or is being written
  std::function<double()> noise;  ///< of the walk; infinite before its first picture
  std::function<void(const std::string& path)> screenshot;
  std::function<void()> quit;
};

/// Plays an input script on a window, an event or so a frame.
class Player {
 public:
  /// `where` names the script in errors.
  Player(std::vector<ScriptStep> steps, std::string where, PlayerHost host);

  /// Called once a frame, before its input is handled: the events to handle now. Throws Error for a control
  /// that is not there, or when what is waited for does not come within `kPatience` seconds.
  std::vector<InputEvent> next(Window& window, const Ui& ui, double seconds);
  /// Nothing to do until what it waits for comes.
  bool waits() const;
  static constexpr double kPatience = 240;

 private:
  using Events = std::vector<InputEvent>;
  void begin(const ScriptStep& step, Window& window, const Ui& ui);
  void pointAt(const glm::dvec2& place);
  void button(int which, bool down);
  void key(const KeyChord& chord);
  void type(const std::string& text);
  glm::dvec2 find(const ScriptPlace& place, const Ui& ui, int line) const;
  bool waiting(double seconds);

  std::deque<ScriptStep> steps_;
  std::string where_;
  PlayerHost host_;
  std::deque<Events> frames_;  ///< what is still to be handled of the step that was begun, frame by frame
  std::optional<double> waitBegan_;
};

}  // namespace lychnite::viewer
