#include "controls.h"
#include "lychnite/app/scene_moves.h"

namespace lychnite::viewer {

/// The clips of the subject's file. What plays is one step of the history when it stops.
void drawAnimationSection(PanelContext& context) {
  Scene& scene = context.session.state().scene;
  Object& subject = scene.objects[subjectIndex(scene)];
  Controls& controls = context.controls;
  Ui& ui = context.ui;
  std::vector<std::string> names{"At rest"};
  int chosen = 0;
  for (const MeshAnimation::Clip& clip : subject.animation->clips()) {
    if (clip.name == subject.clip) chosen = int(names.size());
    names.push_back(clip.name);
  }
  if (ui.choice("Clip",
                "An animation of the model's file. The true size stays that of the model at rest. Poses are "
                "computed for each frame; nothing about the light is computed before.",
                chosen, names)) {
    pose(controls, context.session, [&] { showClip(scene, chosen == 0 ? "" : names[size_t(chosen)], 0); });
    controls.animation.clips = controls.animation.clips && chosen > 0;
  }
  if (ui.button(controls.animation.clips ? "Pause" : "Play", "P. From its end it begins again."))
    togglePlay(controls, context.session);
  if (subject.clip.empty()) return;
  double time = subject.time;
  if (ui.slider("Time, s", "The moment that is shown; scene files keep it.", time, 0,
                clipOf(subject)->seconds, "%.2f")) {
    controls.animation.clips = false;
    pose(controls, context.session, [&] { setPose(subject, subject.clip, time); });
  }
}

}  // namespace lychnite::viewer
