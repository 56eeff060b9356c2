#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lychnite/app/preferences.h"
#include "lychnite/app/session.h"
#include "picture_view.h"
#include "swatches.h"
#include "ui.h"

namespace lychnite::viewer {

/// Motion that goes on by itself.
struct Animation {
  bool lights = false, objects = false;
  bool clips = false;  ///< the model's own
  double degreesPerSecond = 45;
  std::string problem;  ///< why the pose asked for last is not shown, "" when it is
  bool running() const { return lights || objects || clips; }
};

/// What is on the screen beside the document, and not part of what is saved or undone.
struct Controls {
  size_t light = 0;       ///< the one that the mouse turns
  bool asColour = false;  ///< the material as colour and mean free path
  bool showKeys = false;
  Animation animation;
  int pictureWidth = 0, pictureHeight = 0;  ///< of Ctrl+P; 0: as in the window
  std::string sizeText;
  bool editsSize = false;
  bool turnsLight = false;     ///< a hand is on the light now
  bool inspects = false;       ///< the section about what is inside is open
  std::vector<float> frameMs;  ///< of the last frames that drew
};

/// The methods that a window can show, in their order.
const std::vector<Method>& liveMethods();
/// Plays the subject's clip (the first one from rest) or stops where it is.
void togglePlay(Controls& controls, Session& session);
/// Does `work`, which poses objects. Where a file's motion has no such pose the last one stays, playing
/// stops, and it is said once.
void pose(Controls& controls, Session& session, const std::function<void()>& work);

/// What panels work on.
struct PanelContext {
  Ui& ui;
  Session& session;
  Controls& controls;
  PictureView& view;
  Swatches& swatches;
  Preferences& preferences;
  Window& window;
  glm::ivec2 picturePixels{0};
};

/// The panel beside the picture.
void drawPanel(PanelContext& context, const Area& area);
void drawMaterialSection(PanelContext& context);
void drawLightSection(PanelContext& context);
void drawAnimationSection(PanelContext& context);
void drawMethodSection(PanelContext& context);
void drawCompareSection(PanelContext& context);
void drawInspectSection(PanelContext& context);
void drawFileSection(PanelContext& context);

/// The size slider under the picture.
void drawSizeBar(PanelContext& context, const Area& area);
/// What is drawn over the picture: the ruler's numbers, the wipe, the lights' directions, messages, the keys.
void drawOverlay(PanelContext& context, const Area& area, const std::vector<SessionMessage>& messages);
/// The false colours of the difference view and what they stand for, in the lower right corner.
void drawColourBar(PanelContext& context, const Area& area);
/// The samples of the pixel under the mouse, on the light-space map's inset and on the object.
void drawSamples(PanelContext& context, const Area& area);
/// A point of the scene (mm) on the window; nothing behind the camera.
std::optional<glm::dvec2> onWindow(const CameraFrame& camera, const Area& area, const glm::dvec3& point);

/// A heading that opens and closes; true while it is open.
bool sectionOpen(PanelContext& context, const char* title, bool open);

}  // namespace lychnite::viewer
