#pragma once

#include "controls.h"

namespace lychnite::viewer {

/// What mouse and keys do on the picture itself.
class Hands {
 public:
  /// `free`: no control has the mouse.
  void mouse(const InputEvent& event, PanelContext& context, const Area& picture, bool free);
  /// True when the event was a key that does something here.
  bool key(const InputEvent& event, PanelContext& context);
  bool holding() const { return holds_ != Hold::kNothing; }
  bool turnsLight() const { return holds_ == Hold::kLight; }
  /// The person asked to leave (Ctrl+Q).
  bool quit() const { return quit_; }

 private:
  enum class Hold { kNothing, kCamera, kLight, kPan, kWipe };
  Hold holdOf(int button, const PanelContext& context, const Area& picture) const;
  void move(const glm::dvec2& by, PanelContext& context, const Area& picture);
  bool plainKey(int key, PanelContext& context);
  bool controlKey(int key, bool shift, PanelContext& context);

  Hold holds_ = Hold::kNothing;
  int button_ = 0;
  glm::dvec2 at_{0};
  KeyChord modifiers_;
  bool quit_ = false;
};

}  // namespace lychnite::viewer
