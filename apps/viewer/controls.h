#pragma once

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
  double degreesPerSecond = 45;
  bool running() const { return lights || objects; }
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
  std::vector<float> frameMs;  ///< of the last frames that drew
};

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
void drawMethodSection(PanelContext& context);
void drawCompareSection(PanelContext& context);
void drawInspectSection(PanelContext& context);
void drawFileSection(PanelContext& context);

/// The size slider under the picture.
void drawSizeBar(PanelContext& context, const Area& area);
/// What is drawn over the picture: the ruler's numbers, the wipe, the lights' directions, messages, the keys.
void drawOverlay(PanelContext& context, const Area& area, const std::vector<SessionMessage>& messages);

/// A heading that opens and closes; true while it is open.
bool sectionOpen(PanelContext& context, const char* title, bool open);

}  // namespace lychnite::viewer
