// Twins of lib/fresnel, phase, profile, single and surface.
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "lychnite/optics/fresnel.h"
#include "lychnite/optics/phase.h"
#include "lychnite/optics/single.h"
#include "lychnite/optics/surface.h"
#include "parity/technique/twins.h"

namespace lychnite {
namespace {

using Inputs = CaseInputs<double>;
using glm::dvec3;
using glm::dvec4;

constexpr double kPi = std::numbers::pi;

/// A grid in a.x, a.y, a.z.
std::vector<Inputs> scalars(const std::vector<std::vector<double>>& lists) {
  std::vector<Inputs> grid;
  for (const std::vector<double>& row : combinations(lists)) {
    Inputs in{};
    for (size_t i = 0; i < row.size(); ++i) in[0][int(i)] = row[i];
    grid.push_back(in);
  }
  return grid;
}

std::vector<Inputs> withPiC(std::vector<Inputs> grid) {
  for (Inputs& in : grid) in[0].z = double(float(kPi * diffuseTransmittanceOutside(in[0].y)));
  return grid;
}

/// d = a, n = b, eta = a.w: directions against normals, cosines from 0.02 up.
std::vector<Inputs> refractions() {
  std::vector<Inputs> grid;
  for (const dvec3& n : directions())
    for (const dvec3& d : directions())
      for (const double eta : {1.0, 1.3, 1.5, 4.0})
        if (-glm::dot(d, n) > 0.02) grid.push_back({dvec4(d, double(float(eta))), dvec4(n, 0), {}, {}, {}});
  return grid;
}

/// o = a, d = b, centre = c, radius = a.w: rays from in, on and outside the sphere, but for grazing ones,
/// where a float cannot tell a hit from a miss.
std::vector<Inputs> rays() {
  std::vector<Inputs> grid;
  const dvec3 centre(0.25, -0.125, 0.5);
  for (const dvec3& from : directions())
    for (const dvec3& d : directions())
      for (const double far : {0.0, 0.5, 0.75, 2.0}) {
        const dvec3 o = dvec3(glm::vec3(centre + from * (0.75 * far)));
        const double off = glm::length(glm::cross(centre - o, d));
        if (std::abs(off - 0.75) > 0.02)
          grid.push_back({dvec4(o, 0.75), dvec4(d, 0), dvec4(centre, 0), {}, {}});
      }
  return grid;
}

/// base = a, piC = a.w, n = b, eta = b.w, wo = c, roughness = c.w, wi = d. Cosines from 0.05 up: nearer to
/// the horizon a float normal is all that decides.
std::vector<Inputs> coats() {
  std::vector<Inputs> grid;
  for (const dvec3& n : {directions()[0], directions()[9], directions()[30]})
    for (const dvec3& wo : directions())
      for (const dvec3& wi : directions())
        for (const double roughness : {0.02, 0.1, 0.3, 1.0})
          for (const double eta : {1.0, 1.5}) {
            if (std::abs(glm::dot(n, wo)) < 0.05 || std::abs(glm::dot(n, wi)) < 0.05) continue;
            const double piC = double(float(kPi * diffuseTransmittanceOutside(eta)));
            grid.push_back({dvec4(0.25, 0.5, 1, piC),
                            dvec4(n, eta),
                            dvec4(wo, double(float(roughness))),
                            dvec4(wi, 0),
                            {}});
          }
  return grid;
}

dvec4 surfaceTwin(const Inputs& in) {
  const SurfaceCoat coat{.eta = in[1].w, .roughness = in[2].w, .base = dvec3(in[0])};
  const auto unit = [&in](size_t i) { return glm::normalize(dvec3(in[i])); };
  return {surfaceResponse(coat, unit(1), unit(2), unit(3)), 0};
}

/// Walter et al. 2007 eq. 33 as printed, in the angle's tangent.
double ggxByTangent(double sin2H, double alpha) {
  const double cos2 = 1 - sin2H, tan2 = sin2H / cos2, a2 = alpha * alpha, sum = a2 + tan2;
  return a2 / (kPi * cos2 * cos2 * sum * sum);
}

/// Heitz 2014 eq. 72 and 99 as printed.
double smithByLambda(double cosI, double cosO, double alpha) {
  const auto lambda = [alpha](double c) {
    const double tan2 = (1 - c * c) / (c * c);
    return 0.5 * (std::sqrt(1 + alpha * alpha * tan2) - 1);
  };
  return 1 / (1 + lambda(cosI) + lambda(cosO)) / (4 * cosI * cosO);
}

std::vector<Twin> interfaceTwins() {
  const auto cosines = range(0, 1, 65);
  const std::vector<double> etas{0.25, 1 / 1.5, 0.75, 1, 1.05, 1.3, 1.5, 2, 4};
  const std::vector<double> outside{1, 1.05, 1.3, 1.5, 4};
  return {
      {.function = "fresnelReflectance",
       .value = [](const Inputs& in) { return dvec4(fresnelReflectance(in[0].x, in[0].y)); },
       .grid = scalars({cosines, etas}),
       .floor = 0.01},
      {.function = "exitLobe",
       .value = [](const Inputs& in) { return dvec4(exitLobe(in[0].x, in[0].y)); },
       .grid = withPiC(scalars({cosines, outside})),
       .floor = 0.01,
       .formula = 1e-7},  // piC is given as a float
      {.function = "refractedCosine",
       .value =
           [](const Inputs& in) {
             const double c = in[0].x;
             return dvec4(-refract({std::sqrt(1 - c * c), 0, -c}, {0, 0, 1}, in[0].y)->z);
           },
       .grid = scalars({range(0.02, 1, 50), outside}),
       .rounding = 2e-5},  // eta 1 and a cosine of 0.02: 1 - (1 - c^2) cancels
      {.function = "refractInto",
       .value = [](const Inputs& in) { return dvec4(*refract(dvec3(in[0]), dvec3(in[1]), in[0].w), 0); },
       .grid = refractions()},
      {.function = "henyeyGreenstein",
       .value = [](const Inputs& in) { return dvec4(henyeyGreenstein(in[0].x, in[0].y)); },
       .grid = scalars({range(-1, 1, 41), {-0.95, -0.5, -0.1, 0, 0.1, 0.5, 0.8, 0.95}}),
       .floor = 1e-3,
       .rounding = 1e-4},  // |g| = 0.95 at its peak: 1 + g^2 - 2 g cos cancels to 0.0025
  };
}

std::vector<Twin> pathTwins() {
  return {
      {.function = "profileCoordinate",
       .value = [](const Inputs& in) { return dvec4(1 / (1 + in[0].y / in[0].x)); },
       .grid = scalars({{0, 1e-4, 0.01, 0.3, 1, 7, 300}, {1e-3, 0.05, 1, 40}})},
      {.function = "refractedDistance",
       .value = [](const Inputs& in) { return dvec4(refractedDistance(in[0].x, in[0].y, in[0].z)); },
       .grid = scalars({{0, 0.01, 0.5, 3}, range(0.02, 1, 50), {1, 1.05, 1.3, 1.5, 4}}),
       .rounding = 2e-5},  // as refractedCosine
      {.function = "freePath",
       .value = [](const Inputs& in) { return dvec4(freePath(in[0].x, in[0].y, in[0].z)); },
       .grid =
           scalars({{0.002, 0.03, 0.25, 0.5, 0.75, 0.97}, {0, 1e-4, 2e-3, 0.1, 1, 30, 500}, {0.3, 1, 1.7}}),
       .floor = 0.1,     // a third of the shortest path
       .formula = 2e-5,  // the series' own error, largest at its seam
       .rounding = 5e-5,
       .driver = 5e-5},
      {.function = "freePathDensity",
       .value = [](const Inputs& in) { return dvec4(freePathDensity(in[0].x, in[0].y, in[0].z)); },
       .grid = scalars({{0, 0.002, 0.1, 0.3, 0.8}, {0, 1e-4, 2e-3, 0.1, 1, 30}, {0.8, 1, 1.7}}),
       .formula = 2e-5,
       .rounding = 5e-5,
       .driver = 5e-5},
      {.function = "leaveSphere",
       .value =
           [](const Inputs& in) {
             return dvec4(leaveSphere(dvec3(in[0]), dvec3(in[1]), dvec3(in[2]), in[0].w));
           },
       .grid = rays(),
       .floor = 0.1,
       .formula = 1e-6},  // directions rounded to float are unit to that only
  };
}

std::vector<Twin> coatTwins() {
  const auto cosines = range(0.05, 1, 20);
  return {
      {.function = "ggxDistribution",
       .value = [](const Inputs& in) { return dvec4(ggxByTangent(in[0].x, in[0].y)); },
       .grid = scalars({{0, 1e-8, 1e-5, 1e-3, 0.05, 0.3, 0.6, 0.9}, {4e-4, 0.01, 0.09, 0.36, 1}}),
       .floor = 1e-3},
      {.function = "smithVisibility",
       .value = [](const Inputs& in) { return dvec4(smithByLambda(in[0].x, in[0].y, in[0].z)); },
       .grid = scalars({cosines, cosines, {0.01, 0.09, 0.36, 1}})},
      {.function = "surfaceResponse",
       .value = surfaceTwin,
       .grid = coats(),
       .floor = 0.01,
       .formula = 3e-6,  // the normals are unit only as floats
       // A smooth coat's peak (alpha 0.0004) turns with the last bit of the half vector.
       .rounding = 1e-3,
       .driver = 1e-3},
  };
}

}  // namespace

std::vector<Twin> opticsTwins() {
  std::vector<Twin> all = interfaceTwins();
  for (Twin& twin : pathTwins()) all.push_back(std::move(twin));
  for (Twin& twin : coatTwins()) all.push_back(std::move(twin));
  return all;
}

}  // namespace lychnite
