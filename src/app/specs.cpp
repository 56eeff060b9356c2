#include "lychnite/app/specs.h"

#include <fmt/format.h>

#include <charconv>
#include <glm/geometric.hpp>
#include <numbers>

#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/base/units.h"

namespace lychnite {
namespace {

[[noreturn]] void refuse(std::string_view where, std::string expected, std::string_view found) {
  throw Error({.where = std::string(where),
               .expected = std::move(expected),
               .found = fmt::format("'{}'", found),
               .todo = ""},
              Error::Kind::kUsage);
}

/// "kind:rest" cut in two.
std::pair<std::string, std::vector<std::string>> kindAndParts(std::string_view text) {
  const auto colon = text.find(':');
  if (colon == std::string_view::npos) return {std::string(text), {}};
  return {std::string(text.substr(0, colon)), split(text.substr(colon + 1), ',')};
}

/// Part `first` alone, or three parts from it on.
Rgb powerFrom(const std::vector<std::string>& parts, size_t first, std::string_view where) {
  if (parts.size() == first + 1) return Rgb(parseNumber(parts[first], where));
  return {parseNumber(parts[first], where), parseNumber(parts[first + 1], where),
          parseNumber(parts[first + 2], where)};
}

glm::dvec3 positionFrom(const std::vector<std::string>& parts, size_t first, std::string_view where) {
  return {parseLength(parts[first], where), parseLength(parts[first + 1], where),
          parseLength(parts[first + 2], where)};
}

}  // namespace

Rgb parseRgb(std::string_view text, std::string_view where) {
  const auto parts = split(text, ',');
  if (parts.size() != 1 && parts.size() != 3) refuse(where, "R,G,B or one number", text);
  return powerFrom(parts, 0, where);
}

glm::dvec3 parsePosition(std::string_view text, std::string_view where) {
  const auto parts = split(text, ',');
  if (parts.size() != 3) refuse(where, "X,Y,Z with units", text);
  return positionFrom(parts, 0, where);
}

Light parseLight(std::string_view text, std::string_view where) {
  const auto [kind, parts] = kindAndParts(text);
  const size_t n = parts.size();
  if (kind == "parallel" && (n == 2 || n == 3 || n == 5)) {
    ParallelLight light{.azimuth = parseNumber(parts[0], where), .elevation = parseNumber(parts[1], where)};
    if (n > 2) light.irradiance = powerFrom(parts, 2, where);
    return light;
  }
  if (kind == "point" && (n == 3 || n == 4 || n == 6)) {
    PointLight light{.position = positionFrom(parts, 0, where)};
    light.intensity = Rgb(std::numbers::pi * glm::dot(light.position, light.position));
    if (n > 3) light.intensity = powerFrom(parts, 3, where);
    return light;
  }
  refuse(where, "parallel:AZ,EL[,E] or point:X,Y,Z[,I] (E and I one number or R,G,B)", text);
}

Camera parseCamera(std::string_view text, std::string_view where) {
  const auto [kind, parts] = kindAndParts(text);
  const size_t n = parts.size();
  if (kind == "orbit" && n >= 2 && n <= 4) {
    OrbitCamera camera{.azimuth = parseNumber(parts[0], where), .elevation = parseNumber(parts[1], where)};
    if (n > 2) camera.factor = parseNumber(parts[2], where);
    if (n > 3) camera.fov = parseNumber(parts[3], where);
    return camera;
  }
  if (kind == "pinhole" && (n == 6 || n == 7)) {
    PinholeCamera camera{.position = positionFrom(parts, 0, where), .target = positionFrom(parts, 3, where)};
    if (n > 6) camera.fov = parseNumber(parts[6], where);
    return camera;
  }
  refuse(where, "orbit:AZ,EL[,FACTOR[,FOV]] or pinhole:PX,PY,PZ,TX,TY,TZ[,FOV]", text);
}

Resolution parseResolution(std::string_view text, std::string_view where) {
  const auto number = [&](std::string_view part) {
    int value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || end != part.data() + part.size() || value < 1)
      refuse(where, "WxH, both 1 or more", text);
    return value;
  };
  const auto x = text.find('x');
  if (x == std::string_view::npos) refuse(where, "WxH, such as 600x600", text);
  return {number(text.substr(0, x)), number(text.substr(x + 1))};
}

}  // namespace lychnite
