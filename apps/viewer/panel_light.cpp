#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "controls.h"
#include "lychnite/app/scene_moves.h"

namespace lychnite::viewer {
namespace {

/// The power as a colour whose largest channel is 1, and a strength.
bool editPower(Ui& ui, Rgb& power, double high, const char* name, const char* help) {
  double strength = std::max({power.x, power.y, power.z});
  Rgb colour = strength > 0 ? power / strength : Rgb(1);
  bool changed = ui.colour("Colour", "Of the light.", colour);
  changed |= ui.slider(name, help, strength, 0, high, "%.3g", true);
  const double most = std::max({colour.x, colour.y, colour.z, 1e-9});
  if (changed) power = colour / most * strength;
  return changed;
}

void editParallel(Ui& ui, ParallelLight& light) {
  ui.slider("Azimuth, \xc2\xb0",
            "Where the light comes from, about the vertical: 0 in front, 90 from the right, 180 from "
            "behind.",
            light.azimuth, -180, 180, "%.0f");
  ui.slider("Elevation, \xc2\xb0", "How high it stands.", light.elevation, -89, 89, "%.0f");
  editPower(ui, light.irradiance, 100, "Irradiance",
            "On a surface that faces the light. \xcf\x80 makes a white matt surface as bright as white.");
}

void editPoint(Ui& ui, const Scene& scene, PointLight& light) {
  Sphere sphere = boundingSphere(scene, true);
  if (sphere.radius == 0) sphere = boundingSphere(scene);
  glm::dvec3 away = light.position - sphere.centre;
  double distance = std::max(glm::length(away), 1e-6);
  if (ui.slider("Distance, mm",
                "From the object's centre. The intensity follows, so that the centre stays as bright.",
                distance, 1.1 * sphere.radius, 100 * sphere.radius, "%.4g", true)) {
    const double factor = distance / glm::length(away);
    light.position = sphere.centre + away * factor;
    light.intensity *= factor * factor;
    away *= factor;
  }
  const double square = glm::dot(away, away);
  Rgb irradiance = light.intensity / square;
  if (editPower(ui, irradiance, 100, "Irradiance",
                "At the object's centre; the intensity is this times the distance squared."))
    light.intensity = irradiance * square;
}

std::string nameOf(const Light& light, size_t index) {
  return fmt::format("{} {}", std::holds_alternative<PointLight>(light) ? "Point" : "Parallel", index + 1);
}

void drawList(PanelContext& context, Scene& scene) {
  Controls& controls = context.controls;
  std::vector<std::string> names;
  for (size_t i = 0; i < scene.lights.size(); ++i) names.push_back(nameOf(scene.lights[i], i));
  if (!names.empty()) {
    int chosen = int(controls.light);
    if (context.ui.choice("Light", "The one that right-drag or Shift+drag on the picture turns.", chosen,
                          names))
      controls.light = size_t(chosen);
  }
  if (context.ui.button("Add light", "Up to eight; each has a light-space map of its own.",
                        scene.lights.size() < 8)) {
    scene.lights.push_back(ParallelLight{.azimuth = 60, .elevation = 40, .irradiance = Rgb(1)});
    controls.light = scene.lights.size() - 1;
  }
  ImGui::SameLine();
  if (context.ui.button("Remove light", "The chosen one. Ctrl+Z brings it back.", !scene.lights.empty())) {
    scene.lights.erase(scene.lights.begin() + ptrdiff_t(controls.light));
    controls.light = controls.light > 0 ? controls.light - 1 : 0;
  }
}

}  // namespace

void drawLightSection(PanelContext& context) {
  Scene& scene = context.session.state().scene;
  Controls& controls = context.controls;
  controls.light = std::min(controls.light, scene.lights.empty() ? 0 : scene.lights.size() - 1);
  drawList(context, scene);
  if (!scene.lights.empty()) {
    Light& light = scene.lights[controls.light];
    int kind = std::holds_alternative<PointLight>(light) ? 1 : 0;
    if (context.ui.choice("Kind", "Parallel: from infinitely far, as the sun. Point: from a place.", kind,
                          {"Parallel", "Point"}))
      light = kind == 1 ? asPoint(scene, std::get<ParallelLight>(light))
                        : asParallel(scene, std::get<PointLight>(light));
    if (auto* parallel = std::get_if<ParallelLight>(&light))
      editParallel(context.ui, *parallel);
    else
      editPoint(context.ui, scene, std::get<PointLight>(light));
  }
  context.ui.sliders("Ambient", "Radiance of a uniform surrounding without shadows; red, green, blue.",
                     scene.ambient, 0, 10, "%.3g");
  context.ui.check("Orbit lights", "Turns all lights about the object. Space.", controls.animation.lights);
  ImGui::SameLine();
  context.ui.check("Turntable", "Turns the object.", controls.animation.objects);
  context.ui.slider("Speed, \xc2\xb0/s", "Of both.", controls.animation.degreesPerSecond, -180, 180, "%.0f");
}

}  // namespace lychnite::viewer
