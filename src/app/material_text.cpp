#include "lychnite/app/material_text.h"

#include "lychnite/base/text.h"
#include "lychnite/scene/scene_file.h"
#include "scene/scene_toml.h"

namespace lychnite {

std::string materialToToml(const Material& material) {
  Scene scene;
  scene.objects.push_back({.name = "", .model = "sphere", .mesh = nullptr, .material = material});
  const std::string text = sceneToToml(scene);
  return text.substr(text.find("[object.material]"));
}

Material materialFromToml(std::string_view text, std::string_view where) {
  // Headings go, so that a table may be pasted with the one it was copied with.
  std::string scene = "[[object]]\nmodel = \"sphere\"\nsize = \"1mm\"\n[object.material]\n";
  for (const std::string& line : split(text, '\n')) {
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] != '[') scene += line + "\n";
  }
  return sceneFromToml(scene, std::string(where), {}).objects.front().material;
}

Rgb colourOf(const Coefficients& medium) {
  const Rgb albedo = medium.albedo();
  Rgb colour(0);
  for (int c = 0; c < 3; ++c) {
    double low = 0, high = 1;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (albedoFromColour(Rgb(middle), medium.g)[c] < albedo[c] ? low : high) = middle;
    }
    colour[c] = medium.sigma_s[c] > 0 ? 0.5 * (low + high) : 0;
  }
  return colour;
}

}  // namespace lychnite
