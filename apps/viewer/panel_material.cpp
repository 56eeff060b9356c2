#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "controls.h"
#include "lychnite/app/material_text.h"
#include "lychnite/base/units.h"
#include "lychnite/optics/materials.h"

namespace lychnite::viewer {
namespace {

constexpr double kLargestSigma = 500;  // 1/mm, of the sliders; more can be typed into a scene file

/// Share of the font's size at which every name of the library fits below a swatch.
float nameShare(float side) {
  float widest = 1;
  for (const NamedCoefficients& material : materialLibrary())
    widest = std::max(widest, ImGui::CalcTextSize(material.name.c_str()).x);
  return std::min(0.86f, side / widest);
}

/// A swatch with its name below; true when it was chosen.
bool swatchButton(PanelContext& context, size_t index, bool chosen, float side) {
  const NamedCoefficients& material = materialLibrary()[index];
  ImGui::PushID(int(index));
  ImGui::BeginGroup();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool pressed = ImGui::InvisibleButton("swatch", {side, side});
  context.ui.mark("material-" + material.name);
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 end{at.x + side, at.y + side};
  if (const gpu::Texture* texture = context.swatches.texture(index))
    draw.AddImageRounded(reinterpret_cast<ImTextureID>(intptr_t(gpu::foreignName(*texture))), at, end, {0, 1},
                         {1, 0}, IM_COL32_WHITE, 4);
  else
    draw.AddRectFilled(at, end, ImGui::GetColorU32(ImGuiCol_FrameBg), 4);
  if (chosen || hovered)
    draw.AddRect(at, end, ImGui::GetColorU32(chosen ? ImGuiCol_CheckMark : ImGuiCol_TextDisabled), 4, 0,
                 float(1.5 * context.ui.scale()));
  const float size = nameShare(side) * ImGui::GetFontSize();
  const float width = ImGui::CalcTextSize(material.name.c_str()).x * nameShare(side);
  draw.AddText(ImGui::GetFont(), size, {std::round(at.x + 0.5f * (side - width)), end.y + 1},
               ImGui::GetColorU32(chosen ? ImGuiCol_Text : ImGuiCol_TextDisabled), material.name.c_str());
  ImGui::Dummy({side, ImGui::GetFontSize()});
  ImGui::EndGroup();
  if (hovered) {
    const Rgb mfp = material.coefficients.mean_free_path();
    ImGui::SetTooltip(
        "%s", fmt::format("{}: mean free path {} / {} / {} (red, green, blue)\nsource: {}", material.name,
                          formatLength(mfp.x), formatLength(mfp.y), formatLength(mfp.z), material.source)
                  .c_str());
  }
  ImGui::PopID();
  return pressed;
}

void drawLibrary(PanelContext& context, Material& material) {
  constexpr int kColumns = 5;
  const float gap = float(6 * context.ui.scale());
  const float side = std::floor((ImGui::GetContentRegionAvail().x - (kColumns - 1) * gap) / kColumns);
  context.swatches.want(
      context.session.state().scene.objects[subjectIndex(context.session.state().scene)].size,
      std::max(16, int(side)), context.session.state().toneMapping);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, 3});
  for (size_t i = 0; i < materialLibrary().size(); ++i) {
    if (i % kColumns != 0) ImGui::SameLine();
    const NamedCoefficients& known = materialLibrary()[i];
    const bool chosen = !material.opaque && material.name == known.name;
    if (!swatchButton(context, i, chosen, side)) continue;
    material.name = known.name;
    material.medium = known.coefficients;
    material.opaque = false;
  }
  ImGui::PopStyleVar();
}

bool editCoefficients(Ui& ui, Coefficients& medium) {
  bool changed = ui.sliders(
      "\xcf\x83s, 1/mm",
      "Scattering coefficient sigma_s: how often light is scattered on each "
      "millimetre of its way, for red, green and blue (Jensen et al. 2001 measured most of the library's).",
      medium.sigma_s, 0, kLargestSigma, "%.3g");
  changed |= ui.sliders(
      "\xcf\x83"
      "a, 1/mm",
      "Absorption coefficient sigma_a: what share of the light is lost on each "
      "millimetre. Small differences between the channels colour thick parts strongly (Beer's law: "
      "exp(-sigma_a d) is left after d).",
      medium.sigma_a, 0, kLargestSigma, "%.3g");
  return changed;
}

bool editColour(Ui& ui, Coefficients& medium) {
  Rgb colour = glm::min(colourOf(medium), Rgb(0.999));
  Rgb mfp = glm::min(medium.mean_free_path(), Rgb(1e4));
  bool changed =
      ui.colour("Colour",
                "What a thick piece reflects under white light. Turned into coefficients by van de "
                "Hulst's inversion as fitted by Kulla & Conty 2017.",
                colour);
  changed |= ui.sliders("Free path, mm",
                        "Mean free path: how far light goes, on average, between two events of scattering "
                        "or absorption. Things much larger than it look solid, things of its size glow "
                        "through (Jensen et al. 2001).",
                        mfp, 0.001, 1000, "%.3g");
  if (changed)
    medium = coefficientsFromColour(glm::clamp(colour, Rgb(0), Rgb(0.999)), glm::max(mfp, Rgb(1e-4)),
                                    medium.g, medium.eta);
  return changed;
}

/// "0.456 / 0.381 / 0.333 mm"
std::string lengths(const Rgb& mm) {
  std::string text;
  for (int c = 0; c < 3; ++c)
    text += (c > 0 ? " / " : "") +
            (std::isfinite(mm[c]) ? fmt::format("{:.3g}", mm[c]) : std::string("infinite"));
  return text + " mm";
}

void drawDerived(PanelContext& context, const Material& material, double size) {
  const Coefficients& m = material.medium;
  const Rgb mfp = m.mean_free_path(), sigma_tr = m.sigma_tr();
  Rgb reach(0);
  for (int c = 0; c < 3; ++c)
    reach[c] = sigma_tr[c] > 0 ? 1 / sigma_tr[c] : std::numeric_limits<double>::infinity();
  const Rgb albedo = m.albedo();
  context.ui.note(fmt::format(
      "Free path {}\nReach 1/\xcf\x83tr {}\nAlbedo {:.4f} / {:.4f} / {:.4f}\n"
      "The object is {:.3g} / {:.3g} / {:.3g} free paths large",
      lengths(mfp), lengths(reach), albedo.x, albedo.y, albedo.z, size / mfp.x, size / mfp.y, size / mfp.z));
  Ui::help(
      "Light that enters goes about the diffuse reach 1/sigma_tr = 1/sqrt(3 sigma_a sigma_t') before it is "
      "absorbed "
      "(Jensen et al. 2001). An object smaller than that is lit through.");
}

void copyAndPaste(PanelContext& context, Material& material) {
  if (context.ui.button("Copy TOML",
                        "Puts the material on the clipboard as a scene file's [object.material] table."))
    context.window.setClipboard(materialToToml(material));
  ImGui::SameLine();
  if (!context.ui.button("Paste TOML", "Takes a material table from the clipboard.")) return;
  try {
    material = materialFromToml(context.window.clipboard(), "clipboard");
  } catch (const std::exception& error) {
    context.session.say(error.what(), true);
  }
}

}  // namespace

void drawMaterialSection(PanelContext& context) {
  Scene& scene = context.session.state().scene;
  Object& subject = scene.objects[subjectIndex(scene)];
  Material& material = subject.material;
  Ui& ui = context.ui;
  drawLibrary(context, material);
  ImGui::Spacing();
  if (ui.check("Opaque", "A plain diffuse base under the same coat, for comparison.", material.opaque) &&
      material.opaque)
    material.colour = glm::clamp(colourOf(material.medium), Rgb(0), Rgb(1));
  ImGui::SameLine();
  ui.check("As colour and free path",
           "Describe the medium by what a thick piece looks like, instead of by coefficients.",
           context.controls.asColour);
  bool changed = false;
  if (material.opaque)
    ui.colour("Colour", "Diffuse albedo.", material.colour);
  else if (context.controls.asColour)
    changed = editColour(ui, material.medium);
  else
    changed = editCoefficients(ui, material.medium);
  changed |=
      ui.slider("g",
                "Mean cosine of scattering: 0 the same in all directions, towards 1 nearly straight on, "
                "below 0 backwards (Henyey & Greenstein 1941).",
                material.medium.g, -0.95, 0.95, "%.2f");
  changed |=
      ui.slider("Index \xce\xb7", "Refractive index, inside over outside: water 1.33, wax 1.45, marble 1.5.",
                material.medium.eta, 1, 2.5, "%.3f");
  if (changed) material.name = "custom";
  ui.slider(
      "Roughness",
      "Of the coat's surface: 0.02 polished, 1 matt (GGX, Walter et al. 2007; alpha = roughness squared).",
      material.roughness, 0.02, 1, "%.2f");
  if (!material.opaque) drawDerived(context, material, subject.size);
  copyAndPaste(context, material);
}

}  // namespace lychnite::viewer
