#include <fmt/format.h>

#include <filesystem>

#include "controls.h"
#include "lychnite/mesh/builtin.h"

namespace lychnite::viewer {
namespace {

void openButtons(PanelContext& context) {
  context.ui.label(
      "Open",
      "Drop a model (PLY, OBJ, STL, OFF, 3DS, glTF, GLB), a scene (TOML) or a picture (EXR, PNG) on the "
      "window, or choose one.");
  const bool open = ImGui::BeginCombo("##open", context.session.documentName().c_str());
  context.ui.mark("open");
  if (!open) return;
  for (const std::string& path : context.preferences.recent) {
    if (ImGui::Selectable((std::filesystem::path(path).filename().string() + "##" + path).c_str()))
      context.session.open(path);
    Ui::help(path.c_str());
  }
  if (!context.preferences.recent.empty()) ImGui::Separator();
  for (const BuiltinModel& model : builtinModels()) {
    if (ImGui::Selectable(model.name.c_str())) context.session.open(model.name);
    context.ui.mark("open-" + model.name);
    Ui::help(model.description.c_str());
  }
  ImGui::EndCombo();
}

void pictureRow(PanelContext& context) {
  Controls& controls = context.controls;
  int size[2] = {controls.pictureWidth > 0 ? controls.pictureWidth : context.picturePixels.x,
                 controls.pictureHeight > 0 ? controls.pictureHeight : context.picturePixels.y};
  context.ui.label("Picture size", "Pixels of the picture that Ctrl+P writes.");
  if (ImGui::InputInt2("##size", size)) {
    controls.pictureWidth = std::clamp(size[0], 1, 16384);
    controls.pictureHeight = std::clamp(size[1], 1, 16384);
  }
  context.ui.mark("picture-size");
  const int width = size[0], height = size[1];
  if (context.ui.button("Write PNG", "Ctrl+P. Exactly what `lychnite render` of the saved scene gives."))
    context.session.savePicture(width, height);
  ImGui::SameLine();
  if (context.ui.button("Write EXR", "Ctrl+Shift+P. Linear values, all of them.")) {
    const std::filesystem::path stem = std::filesystem::path(context.session.documentName()).stem();
    context.session.savePicture(width, height, {}, ".exr");
  }
  ImGui::SameLine();
  if (context.ui.button("Copy command",
                        "The command line that writes the same picture from the saved scene.")) {
    const std::string scene =
        context.session.scenePath().empty() ? "scene.toml" : context.session.scenePath().string();
    context.window.setClipboard(renderCommand(context.session.state(), scene, "picture.png", width, height));
  }
}

bool moves(const PanelContext& context) {
  const Scene& scene = context.session.state().scene;
  return scene.objects[subjectIndex(scene)].animation != nullptr;
}

}  // namespace

bool sectionOpen(PanelContext& context, const char* title, bool open) {
  const bool shown =
      ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
  context.ui.mark("section-" + markName(title));
  return shown;
}

void drawFileSection(PanelContext& context) {
  Session& session = context.session;
  openButtons(context);
  if (context.ui.button("Save scene", "Ctrl+S. As TOML, beside the model's pictures.")) session.saveScene();
  ImGui::SameLine();
  if (context.ui.button("Undo", "Ctrl+Z", session.canUndo())) session.undo();
  ImGui::SameLine();
  if (context.ui.button("Redo", "Ctrl+Shift+Z", session.canRedo())) session.redo();
  pictureRow(context);
  if (session.pictures().busy()) {
    ImGui::ProgressBar(float(session.pictures().fraction()), {-1, 0});
    if (context.ui.button("Cancel picture", "Nothing is written then, and pictures that wait are dropped."))
      session.pictures().cancel();
  }
}

void drawPanel(PanelContext& context, const Area& area) {
  ImGui::SetNextWindowPos(toIm(area.low));
  ImGui::SetNextWindowSize(toIm(area.size()));
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
  context.ui.mark("panel", area);
  if (!context.session.empty()) {
    struct Section {
      const char* title;
      void (*draw)(PanelContext&);
      bool open;
    };
    for (const Section& section :
         {Section{"Material", drawMaterialSection, true}, Section{"Light", drawLightSection, true},
          Section{"Animation", drawAnimationSection, true}, Section{"Picture", drawMethodSection, false},
          Section{"Compare", drawCompareSection, false}, Section{"Inside", drawInspectSection, false},
          Section{"File", drawFileSection, false}}) {
      if (section.draw == drawAnimationSection && !moves(context)) continue;
      if (!sectionOpen(context, section.title, section.open)) continue;
      section.draw(context);
      ImGui::Spacing();
    }
  }
  ImGui::End();
}

}  // namespace lychnite::viewer
