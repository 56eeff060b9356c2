#include "scene/scene_toml.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene_file.h"
#include "scene/toml_reader.h"

namespace lychnite {
namespace fs = std::filesystem;

namespace {

Material namedMaterial(const std::string& name, const std::string& where) {
  Material material;
  material.name = name;
  material.medium = findMaterial(name, where).coefficients;
  return material;
}

Material readMaterial(const toml::table& table, const std::string& file) {
  const TomlReader in(table, file,
                      {"name", "sigma_s", "sigma_a", "g", "eta", "roughness", "opaque", "colour"});
  Material material;
  material.opaque = in.boolean("opaque", false);
  const bool named = in.has("name") && in.text("name") != "custom";
  if (named)
    material = namedMaterial(in.text("name"), in.where("name"));
  else if (!in.has("sigma_s") && !material.opaque)
    in.refuse("sigma_s", "a material's name, or sigma_s and sigma_a in 1/mm");
  const Coefficients library = material.medium;
  material.opaque = in.boolean("opaque", false);
  material.medium.sigma_s = in.numbers("sigma_s", material.medium.sigma_s);
  material.medium.sigma_a = in.numbers("sigma_a", material.medium.sigma_a);
  material.medium.g = in.number("g", material.medium.g);
  material.medium.eta = in.number("eta", material.medium.eta);
  if (!named || material.medium != library) material.name = "custom";
  material.roughness = in.number("roughness", material.roughness);
  material.colour = in.numbers("colour", material.colour);
  validate(material.medium, in.place());
  return material;
}

Object readObject(const toml::table& table, const fs::path& path, const LogSink& log) {
  const TomlReader in(
      table, path.string(),
      {"name", "model", "animation", "time", "size", "position", "rotation", "quaternion", "material"});
  Object object = loadObject(in.text("model"), path.has_parent_path() ? path.parent_path() : ".", log);
  object.name = in.text("name", "");
  if (in.has("time") && !in.has("animation")) in.refuse("time", "an animation beside it");
  if (in.has("animation")) {
    const double seconds = in.number("time", 0);
    if (!std::isfinite(seconds) || seconds < 0) in.refuse("time", "seconds, 0 or more");
    try {
      setPose(object, in.text("animation"), seconds);
    } catch (const Error& error) {
      Error::Parts parts = error.parts();
      parts.where = in.where("animation");
      throw Error(parts);
    }
  }
  if (!in.has("size")) in.refuse("size", "the object's true size, the longest side of its box (\"20mm\")");
  object.size = in.length("size", 0);
  if (!(object.size > 0)) in.refuse("size", "a length above zero");
  object.position = in.lengths("position", object.position);
  if (in.has("quaternion")) {
    const toml::array* q = in.node("quaternion")->as_array();
    if (!q || q->size() != 4 || !q->is_homogeneous<double>())
      in.refuse("quaternion", "four numbers with a point: w, x, y, z");
    const auto at = [q](size_t i) { return (*q)[i].value_or(0.0); };
    object.rotation = glm::dquat(at(0), at(1), at(2), at(3));
    const double length = glm::length(object.rotation);
    if (!(length > 1e-6) || !std::isfinite(length))
      in.refuse("quaternion", "four numbers that are not all 0");
    // What we wrote ourselves is taken as it is, so that reading gives back what was written.
    if (std::abs(length - 1) > 1e-12) object.rotation /= length;
  } else {
    object.rotation = glm::dquat(glm::radians(in.numbers("rotation", glm::dvec3(0))));
  }
  if (const toml::node* material = in.node("material"); material && material->is_table())
    object.material = readMaterial(*material->as_table(), path.string());
  else
    object.material = namedMaterial(in.text("material", "marble"), in.where("material"));
  return object;
}

Light readLight(const toml::table& table, const std::string& file) {
  const TomlReader in(table, file, {"type", "azimuth", "elevation", "irradiance", "position", "intensity"});
  const std::string type = in.text("type");
  if (type == "parallel") {
    ParallelLight light;
    light.azimuth = in.number("azimuth", light.azimuth);
    light.elevation = in.number("elevation", light.elevation);
    light.irradiance = in.numbers("irradiance", light.irradiance);
    return light;
  }
  if (type != "point") in.refuse("type", "\"parallel\" or \"point\"");
  PointLight light;
  if (!in.has("position")) in.refuse("position", "where the point light is, three lengths");
  light.position = in.lengths("position", light.position);
  light.intensity = in.numbers("intensity", light.intensity);
  return light;
}

Camera readCamera(const toml::table& table, const std::string& file) {
  const TomlReader in(table, file,
                      {"type", "azimuth", "elevation", "factor", "fov", "position", "target", "up"});
  const std::string type = in.text("type", "orbit");
  if (type == "orbit") {
    OrbitCamera camera;
    camera.azimuth = in.number("azimuth", camera.azimuth);
    camera.elevation = in.number("elevation", camera.elevation);
    camera.factor = in.number("factor", camera.factor);
    camera.fov = in.number("fov", camera.fov);
    return camera;
  }
  if (type != "pinhole") in.refuse("type", "\"orbit\" or \"pinhole\"");
  PinholeCamera camera;
  camera.position = in.lengths("position", camera.position);
  camera.target = in.lengths("target", camera.target);
  camera.up = in.numbers("up", camera.up);
  camera.fov = in.number("fov", camera.fov);
  return camera;
}

std::string numbersText(const glm::dvec3& v) {
  return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}
std::string lengthsText(const glm::dvec3& v) {
  return fmt::format("[\"{}mm\", \"{}mm\", \"{}mm\"]", v.x, v.y, v.z);
}

/// The library's name where it says everything, the coefficients otherwise.
std::string mediumText(const Material& material) {
  for (const NamedCoefficients& known : materialLibrary())
    if (known.name == material.name && known.coefficients == material.medium)
      return fmt::format("name = {}\n", tomlString(material.name));
  const Coefficients& medium = material.medium;
  return fmt::format("name = \"custom\"\nsigma_s = {}  # 1/mm\nsigma_a = {}\ng = {}\neta = {}\n",
                     numbersText(medium.sigma_s), numbersText(medium.sigma_a), medium.g, medium.eta);
}

std::string objectText(const Object& object) {
  std::string text = "\n[[object]]\n";
  if (!object.name.empty()) text += fmt::format("name = {}\n", tomlString(object.name));
  text += fmt::format("model = {}\n", tomlString(object.model));
  if (!object.clip.empty())
    text += fmt::format("animation = {}\ntime = {}  # s\n", tomlString(object.clip), object.time);
  text += fmt::format("size = \"{}mm\"\n", object.size);
  if (object.position != glm::dvec3(0)) text += fmt::format("position = {}\n", lengthsText(object.position));
  const glm::dquat& q = object.rotation;
  if (q != glm::dquat(1, 0, 0, 0))
    text += fmt::format("quaternion = [{:#}, {:#}, {:#}, {:#}]\n", q.w, q.x, q.y, q.z);
  text += "[object.material]\n" + mediumText(object.material);
  const Material& material = object.material;
  text += fmt::format("roughness = {}\n", material.roughness);
  if (material.opaque) text += fmt::format("opaque = true\ncolour = {}\n", numbersText(material.colour));
  return text;
}

std::string lightText(const Light& light) {
  if (const auto* parallel = std::get_if<ParallelLight>(&light))
    return fmt::format("\n[[light]]\ntype = \"parallel\"\nazimuth = {}\nelevation = {}\nirradiance = {}\n",
                       parallel->azimuth, parallel->elevation, numbersText(parallel->irradiance));
  const auto& point = std::get<PointLight>(light);
  return fmt::format("\n[[light]]\ntype = \"point\"\nposition = {}\nintensity = {}\n",
                     lengthsText(point.position), numbersText(point.intensity));
}

std::string cameraText(const Camera& camera) {
  if (const auto* orbit = std::get_if<OrbitCamera>(&camera))
    return fmt::format("\n[camera]\ntype = \"orbit\"\nazimuth = {}\nelevation = {}\nfactor = {}\nfov = {}\n",
                       orbit->azimuth, orbit->elevation, orbit->factor, orbit->fov);
  const auto& pinhole = std::get<PinholeCamera>(camera);
  return fmt::format("\n[camera]\ntype = \"pinhole\"\nposition = {}\ntarget = {}\nup = {}\nfov = {}\n",
                     lengthsText(pinhole.position), lengthsText(pinhole.target), numbersText(pinhole.up),
                     pinhole.fov);
}

}  // namespace

Scene sceneFromToml(const std::string& text, const fs::path& path, const LogSink& log) {
  const std::string file = path.string();
  toml::table root;
  try {
    root = toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw Error({.where = fmt::format("{}:{}", file, error.source().begin.line),
                 .expected = "",
                 .found = std::string(error.description()),
                 .todo = ""});
  }
  const TomlReader in(root, file, {"background", "ambient", "camera", "object", "light"});
  Scene scene;
  scene.background = in.numbers("background", scene.background);
  scene.ambient = in.numbers("ambient", scene.ambient);
  if (const toml::table* camera = in.table("camera")) scene.camera = readCamera(*camera, file);
  if (const toml::array* objects = in.array("object"))
    for (const toml::node& node : *objects) scene.objects.push_back(readObject(*node.as_table(), path, log));
  if (const toml::array* lights = in.array("light"))
    for (const toml::node& node : *lights) scene.lights.push_back(readLight(*node.as_table(), file));
  if (scene.objects.empty()) in.refuse("object", "at least one [[object]]");
  return scene;
}

std::string sceneToToml(const Scene& scene) {
  std::string text = fmt::format("background = {}\nambient = {}\n", numbersText(scene.background),
                                 numbersText(scene.ambient));
  text += cameraText(scene.camera);
  for (const Object& object : scene.objects) text += objectText(object);
  for (const Light& light : scene.lights) text += lightText(light);
  return text;
}

}  // namespace lychnite
