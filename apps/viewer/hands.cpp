#include "hands.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "lychnite/app/scene_moves.h"
#include "lychnite/base/error.h"

namespace lychnite::viewer {
namespace {

constexpr double kDegreesPerHeight = 240;  // of a drag over the picture's whole height
constexpr double kZoomPerNotch = 0.88;

void toggle(CompareView& compare, CompareView::Mode mode) {
  compare.mode = compare.mode == mode ? CompareView::Mode::kOff : mode;
}

void nextMethod(RenderSettings& settings) {
  const auto& methods = liveMethods();
  const auto now = std::find(methods.begin(), methods.end(), settings.method);
  settings.method = now + 1 < methods.end() ? now[1] : methods.front();
}

}  // namespace

void pose(Controls& controls, Session& session, const std::function<void()>& work) {
  std::string& problem = controls.animation.problem;
  try {
    work();
    problem.clear();
  } catch (const Error& error) {
    if (error.kind() == Error::Kind::kDevice) throw;
    controls.animation.clips = false;
    if (problem.empty()) session.say(error.what(), true);
    problem = error.what();
  }
}

void togglePlay(Controls& controls, Session& session) {
  Scene& scene = session.state().scene;
  Object& subject = scene.objects[subjectIndex(scene)];
  const MeshAnimation::Clip* clip = clipOf(subject);
  if (!clip) return;
  controls.animation.clips = !controls.animation.clips;
  if (controls.animation.clips && subject.clip.empty())
    pose(controls, session, [&] { showClip(scene, clip->name, 0); });
}

Hands::Hold Hands::holdOf(int button, const PanelContext& context, const Area& picture) const {
  const CompareView& compare = context.session.state().compare;
  const double wipe = picture.low.x + compare.wipe * picture.size().x;
  if (button == 0 && compare.mode == CompareView::Mode::kWipe &&
      std::abs(at_.x - wipe) < 7 * context.ui.scale())
    return Hold::kWipe;
  if (button == 2 || (button == 0 && modifiers_.ctrl)) return Hold::kPan;
  if (button == 1 || modifiers_.shift) return Hold::kLight;
  return Hold::kCamera;
}

void Hands::mouse(const InputEvent& event, PanelContext& context, const Area& picture, bool free) {
  const bool over = free && picture.holds(at_) && !context.session.empty();
  switch (event.kind) {
    case InputEvent::Kind::kMove:
      if (holding()) move(event.at - at_, context, picture);
      at_ = event.at;
      break;
    case InputEvent::Kind::kButton:
      if (event.down && !holding() && over) {
        holds_ = holdOf(event.button, context, picture);
        button_ = event.button;
      } else if (!event.down && event.button == button_) {
        holds_ = Hold::kNothing;
      }
      break;
    case InputEvent::Kind::kScroll:
      if (over) zoomCamera(context.session.state().scene, std::pow(kZoomPerNotch, event.notches));
      break;
    default:
      break;
  }
}

void Hands::move(const glm::dvec2& by, PanelContext& context, const Area& picture) {
  ViewState& state = context.session.state();
  const double height = std::max(picture.size().y, 1.0);
  const glm::dvec2 turn = by * (kDegreesPerHeight / height);
  switch (holds_) {
    case Hold::kCamera:
      return orbitCamera(state.scene, -turn.x, turn.y);
    case Hold::kLight:
      return turnLight(state.scene, context.controls.light, turn.x, -turn.y);
    case Hold::kPan:
      return panCamera(state.scene, by.x / height, -by.y / height);
    case Hold::kWipe:
      state.compare.wipe = std::clamp(state.compare.wipe + by.x / picture.size().x, 0.0, 1.0);
      return;
    case Hold::kNothing:
      return;
  }
}

bool Hands::key(const InputEvent& event, PanelContext& context) {
  if (event.kind != InputEvent::Kind::kKey) return false;
  modifiers_ = event.modifiers;
  if (event.key == GLFW_KEY_LEFT_SHIFT || event.key == GLFW_KEY_RIGHT_SHIFT) modifiers_.shift = event.down;
  if (event.key == GLFW_KEY_LEFT_CONTROL || event.key == GLFW_KEY_RIGHT_CONTROL) modifiers_.ctrl = event.down;
  if (!event.down) return false;
  if (event.modifiers.ctrl) return controlKey(event.key, event.modifiers.shift, context);
  return plainKey(event.key, context);
}

bool Hands::controlKey(int key, bool shift, PanelContext& context) {
  Session& session = context.session;
  switch (key) {
    case GLFW_KEY_Z:
      shift ? session.redo() : session.undo();
      return true;
    case GLFW_KEY_Y:
      session.redo();
      return true;
    case GLFW_KEY_S:
      session.saveScene();
      return true;
    case GLFW_KEY_P: {
      const Controls& controls = context.controls;
      session.savePicture(controls.pictureWidth > 0 ? controls.pictureWidth : context.picturePixels.x,
                          controls.pictureHeight > 0 ? controls.pictureHeight : context.picturePixels.y, {},
                          shift ? ".exr" : ".png");
      return true;
    }
    case GLFW_KEY_Q:
      quit_ = true;
      return true;
    default:
      return false;
  }
}

bool Hands::plainKey(int key, PanelContext& context) {
  if (key == GLFW_KEY_H || key == GLFW_KEY_F1) context.controls.showKeys = !context.controls.showKeys;
  if (key == GLFW_KEY_ESCAPE) context.controls.showKeys = false;
  if (context.session.empty()) return false;
  ViewState& state = context.session.state();
  Scene& scene = state.scene;
  const double size = scene.objects[subjectIndex(scene)].size;
  if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9) setView(scene, key - GLFW_KEY_0);
  if (key == GLFW_KEY_F) fitCamera(scene);
  if (key == GLFW_KEY_LEFT_BRACKET) setSubjectSize(scene, size / 2);
  if (key == GLFW_KEY_RIGHT_BRACKET) setSubjectSize(scene, size * 2);
  if (key == GLFW_KEY_SPACE) context.controls.animation.lights = !context.controls.animation.lights;
  if (key == GLFW_KEY_M) nextMethod(state.settings);
  if (key == GLFW_KEY_P) togglePlay(context.controls, context.session);
  if (key == GLFW_KEY_G) state.ruler = !state.ruler;
  if (key == GLFW_KEY_I) state.inspect.samples = !state.inspect.samples;
  if (key == GLFW_KEY_C) toggle(state.compare, CompareView::Mode::kWipe);
  if (key == GLFW_KEY_D) toggle(state.compare, CompareView::Mode::kDifference);
  return true;
}

}  // namespace lychnite::viewer
