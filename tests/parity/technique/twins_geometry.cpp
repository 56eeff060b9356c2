// Twins of lib/octahedral, light_map and spiral.
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "parity/technique/twins.h"
#include "technique/light_map/light_view.h"

namespace lychnite {
namespace {

using Inputs = CaseInputs<double>;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

/// The octahedron's upper half is the shadow of the unit vector in the 1-norm; its lower half is that
/// mirrored in the diagonal of the quadrant.
dvec4 encodeByMirror(const Inputs& in) {
  const dvec3 n(in[0]);
  dvec2 q = dvec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  if (n.z < 0) {
    const dvec2 m(std::copysign(std::sqrt(0.5), n.x), std::copysign(std::sqrt(0.5), n.y));
    q -= 2 * (glm::dot(q, m) - std::sqrt(0.5)) * m;
  }
  return {q, 0, 0};
}

dvec4 decodeByMirror(const Inputs& in) {
  dvec2 q(in[0]);
  const double above = 1 - std::abs(q.x) - std::abs(q.y);
  const dvec2 m(std::copysign(std::sqrt(0.5), q.x), std::copysign(std::sqrt(0.5), q.y));
  if (above < 0) q -= 2 * (glm::dot(q, m) - std::sqrt(0.5)) * m;
  return {glm::normalize(dvec3(q, above)), 0};
}

std::vector<Inputs> unitVectors() {
  std::vector<Inputs> grid;
  for (const dvec3& d : directions()) grid.push_back({dvec4(d, 0), {}, {}, {}, {}});
  return grid;
}

std::vector<Inputs> numbers(const std::vector<std::vector<double>>& lists) {
  std::vector<Inputs> grid;
  for (const std::vector<double>& row : combinations(lists)) {
    Inputs in{};
    for (size_t i = 0; i < row.size(); ++i) in[0][int(i)] = row[i];
    grid.push_back(in);
  }
  return grid;
}

/// A view in a to d and a point, or (u, v, depth), in e; e.w is a depth or a difference of depths.
std::vector<Inputs> views(bool mapPoints) {
  std::vector<Inputs> grid;
  for (const dvec3& forward : directions())
    for (const double perspective : {0.0, 1.0}) {
      const dvec3 hint = std::abs(forward.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(0, 0, 1);
      const dvec3 right(glm::vec3(glm::normalize(glm::cross(forward, hint))));
      const dvec3 up(glm::vec3(glm::cross(right, forward)));
      const dvec3 origin(glm::vec3(dvec3(0.125, -0.25, 0.5) - 2.0 * forward));
      const double halfWidth = perspective > 0 ? 0.375 : 0.75;
      for (const dvec3& p :
           {dvec3(0.125, -0.25, 0.5), dvec3(0.5, 0.25, 0.25), dvec3(-0.125, -0.625, 0.875)}) {
        const dvec3 last = mapPoints ? dvec3(p.x + 0.25, p.y + 0.5, 1 + p.z) : p;
        grid.push_back({dvec4(origin, halfWidth), dvec4(right, perspective), dvec4(up, 0), dvec4(forward, 0),
                        dvec4(last, 1.75)});
      }
    }
  return grid;
}

LightView viewOf(const Inputs& in) {
  LightView view;
  view.origin = dvec3(in[0]);
  view.right = dvec3(in[1]);
  view.up = dvec3(in[2]);
  view.forward = dvec3(in[3]);
  view.halfWidth = in[0].w;
  view.perspective = in[1].w > 0.5;
  return view;
}

dvec4 irradianceTwin(const Inputs& in) {
  const LightView view = viewOf(in);
  const double distance = glm::distance(dvec3(in[4]), view.origin);
  return dvec4(dvec3(1, 2, 5) * (view.perspective ? std::pow(distance, -2.0) : 1.0), 0);
}

/// The circle met by a ray from a point inside: |e0 centre - t direction| = rc, the larger root.
double circleByRoots(double e0, double rc, double phi) {
  const dvec2 centre(e0, 0), d(std::cos(phi), std::sin(phi));
  const double b = glm::dot(centre, d), c = glm::dot(centre, centre) - rc * rc;
  return b + std::sqrt(std::max(0.0, b * b - c));
}

std::vector<Twin> octahedralTwins() {
  return {
      {.function = "octSign",
       .value = [](const Inputs& in) { return dvec4(std::copysign(1.0, in[0].x)); },
       .grid = numbers({{-2, -1e-30, 0, 1e-30, 3}})},
      {.function = "octEncode", .value = encodeByMirror, .grid = unitVectors(), .floor = 0.1},
      {.function = "octDecode",
       .value = decodeByMirror,
       .grid = numbers({range(-1, 1, 33), range(-1, 1, 33)})},
  };
}

std::vector<Twin> viewTwins() {
  return {
      {.function = "projectToMap",
       .value = [](const Inputs& in) { return dvec4(viewOf(in).project(dvec3(in[4])), 0); },
       .grid = views(false)},
      {.function = "unprojectFromMap",
       .value = [](const Inputs& in) { return dvec4(viewOf(in).unproject(dvec2(in[4]), in[4].z), 0); },
       .grid = views(true)},
      {.function = "lightTravel",
       .value = [](const Inputs& in) { return dvec4(viewOf(in).travel(dvec3(in[4])), 0); },
       .grid = views(false)},
      {.function = "facingIrradiance", .value = irradianceTwin, .grid = views(false)},
      {.function = "windowArea",
       .value = [](const Inputs& in) { return dvec4(viewOf(in).windowArea(dvec3(in[4]), in[4].w)); },
       .grid = views(false)},
      {.function = "depthToDistance",
       .value =
           [](const Inputs& in) {
             // From the point back along its own ray: two points of that ray whose depths differ by e.w.
             const LightView view = viewOf(in);
             const dvec3 p(in[4]), t = view.travel(p);
             const double rate = view.project(p + t).z - view.project(p).z;
             return dvec4(in[4].w / rate);
           },
       .grid = views(false)},
  };
}

/// Eccentric points and radii with the cosine and sine of a full turn of directions.
std::vector<Inputs> aroundTheCircle(const std::vector<double>& offsets, const std::vector<double>& radii) {
  std::vector<Inputs> grid;
  for (const double offset : offsets)
    for (const double radius : radii)
      for (int i = 0; i < 33; ++i) {
        const double phi = 2 * std::numbers::pi * i / 32;
        grid.push_back({dvec4(offset, radius, float(std::cos(phi)), float(std::sin(phi))), {}, {}, {}, {}});
      }
  return grid;
}

std::vector<Twin> spiralTwins() {
  return {
      {.function = "radialShare",
       .value = [](const Inputs& in) { return dvec4(1 / (1 + in[0].y / in[0].x)); },
       .grid = numbers({{0, 1e-3, 0.1, 1, 20}, {0.01, 0.3, 5}})},
      {.function = "radiusOfShare",
       .value = [](const Inputs& in) { return dvec4(in[0].y / (1 / in[0].x - 1)); },
       .grid = numbers({{1e-3, 0.1, 0.5, 0.9, 0.99}, {0.01, 0.3, 5}})},
      {.function = "denserAhead",
       .value =
           [](const Inputs& in) {
             // The true anomaly of an orbit whose eccentric anomaly turns evenly.
             const double m = in[0].x, ratio = std::sqrt((1 - in[0].y) / (1 + in[0].y));
             const double phi = 2 * std::atan2(ratio * std::sin(m / 2), std::cos(m / 2));
             const double half = std::cos(m / 2), other = std::sin(m / 2);
             return dvec4(std::cos(phi), std::sin(phi), ratio / (half * half + ratio * ratio * other * other),
                          0);
           },
       .grid = numbers({{0, 0.4, 1.6, 3, 4, 6}, {0, 0.3, 0.7, 0.9}}),
       .floor = 0.1},
      {.function = "distanceToCircle",
       .value =
           [](const Inputs& in) {
             return dvec4(circleByRoots(in[0].x, in[0].y, std::atan2(in[0].w, in[0].z)));
           },
       .grid = aroundTheCircle({0, 0.1, 0.3, 0.45}, {0.5, 0.525}),
       .floor = 0.1,
       .formula = 1e-6},  // cosine and sine are floats, so their squares do not quite add up to 1
  };
}

}  // namespace

std::vector<Twin> geometryTwins() {
  std::vector<Twin> all = octahedralTwins();
  for (Twin& twin : viewTwins()) all.push_back(std::move(twin));
  for (Twin& twin : spiralTwins()) all.push_back(std::move(twin));
  return all;
}

}  // namespace lychnite
