#include "models.h"

#include <algorithm>

#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/base/units.h"
#include "lychnite/reference/surface_walk.h"
#include "lychnite/volume/volume.h"
#include "reference/hierarchical.h"
#include "references.h"

namespace lychnite::accuracy {

namespace {

constexpr size_t kPoints = 8;  // of a patch

RenderSettings settingsOf(const Column& column, int pixels) {
  RenderSettings settings;
  settings.width = settings.height = pixels;
  settings.method = column.method;
  settings.profile = column.profile;
  settings.components = {.multiple = true, .single = false, .surface = false};
  settings.cells = column.cells;
  settings.passes = column.passes;
  return settings;
}

/// A solver of its own, so that a score does not depend on what was measured before.
VolumeSolver solved(const Scene& scene, const Column& column, uint64_t seed, const Progress& progress) {
  VolumeSolver solver;
  const std::string obstacle = solver.obstacle(scene);
  if (!obstacle.empty())
    throw Error({.where = "volume", .expected = "a shape with an inside", .found = obstacle, .todo = {}});
  const int cells = column.cells > 0 ? column.cells : volumeCells(scene);
  solver.update(scene, {.cells = cells, .seed = seed}, progress);
  for (int pass = 0; pass < column.passes; ++pass) solver.refine(progress);
  return solver;
}

Values profileAt(const Scene& scene, const Column& column, const std::vector<MeshPoint>& points,
                 const ProfileMaker& profiles, const Progress& progress) {
  const RayScene rays(scene);
  CameraReceivers receivers;  // of no camera: only where they are is read
  for (const MeshPoint& point : points)
    receivers.receivers.push_back({.hit = rays.hitOf(0, point.triangle, point.u, point.v, 0)});
  return sumHierarchical(rays, receivers, settingsOf(column, 1), {.profiles = profiles}, progress).radiosity;
}

/// "volume[:CELLS[:PASSES]]" or "first[:CELLS]".
Column volumeColumn(const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  Column column{.name = text, .method = Method::kVolume};
  const bool first = parts[0] == "first";
  if (first) column.passes = 0, column.cells = kLiveVolumeCells;
  const auto number = [&](size_t i, double low, double high) {
    const double value = parseNumber(parts[i], "--columns");
    if (value != std::floor(value) || value < low || value > high || parts.size() > (first ? 2u : 3u))
      throw Error({.where = "--columns",
                   .expected = "volume[:CELLS[:PASSES]] (8 to 192 cells or 0 for its own, 1 to 10000 passes) "
                               "or first[:CELLS]",
                   .found = "'" + text + "'",
                   .todo = {}},
                  Error::Kind::kUsage);
    return int(value);
  };
  if (parts.size() > 1 && parts[1] != "0") column.cells = number(1, 8, 192);
  if (parts.size() > 2) column.passes = number(2, 1, 10000);
  return column;
}

}  // namespace

Column columnOf(const std::string& text) {
  for (const ProfileKind kind : {ProfileKind::kDipole, ProfileKind::kBetterDipole,
                                 ProfileKind::kNormalizedDiffusion, ProfileKind::kTabulated})
    if (text == profileName(kind))
      return {.name = text, .profile = kind, .fromSecond = kind == ProfileKind::kBetterDipole};
  if (text == "tabulated-two-up")
    return {.name = text, .profile = ProfileKind::kTabulated, .fromSecond = true};
  if (text == "first" || text.starts_with("first:") || text == "volume" || text.starts_with("volume:"))
    return volumeColumn(text);
  const Column column{.name = text, .method = parseMethod(text, "--columns")};
  if (column.method == Method::kWalk)
    throw Error(
        {.where = "--columns", .expected = "what is held against the walk", .found = "'walk'", .todo = {}},
        Error::Kind::kUsage);
  return column;
}

void requireOnSurface(const Column& column) {
  if (!column.fromSecond) return;
  throw Error({.where = "--columns",
               .expected = "columns with a radiosity of all orders",
               .found = "'" + column.name + "', which has none of order one",
               .todo = "take --unit picture for it"},
              Error::Kind::kUsage);
}

Values valuesOf(const Image& image, const std::string& layer) {
  Values values(image.pixelCount());
  for (size_t i = 0; i < values.size(); ++i) values[i] = image.rgb(i, layer);
  return values;
}

const std::vector<MeshPoint>& Models::pointsOf(const Cell& cell) {
  std::vector<MeshPoint>& points = points_[cell.shape];
  if (points.empty()) points = patchPoints(shapes_.sceneOf(cell), 0, kPatches, kPoints);
  return points;
}

Halves Models::onSurface(const Cell& cell, const Column& column, const Progress& progress) {
  const Scene scene = shapes_.sceneOf(cell);
  const std::vector<MeshPoint>& points = pointsOf(cell);
  const auto told = [&](uint64_t seed) {
    if (column.method != Method::kVolume)
      return means(profileAt(scene, column, points, profiles_.maker(), progress), kPoints);
    const VolumeSolver solver = solved(scene, column, seed, progress);
    return means(solver.pointRadiosity(0, points, VolumeSolver::Orders::kAll), kPoints);
  };
  Halves halves{told(1), {}};
  halves[1] = column.method == Method::kVolume && column.passes > 0 ? told(2) : halves[0];
  return halves;
}

Values Models::inPicture(const Cell& cell, const Column& column, int pixels, const Progress& progress) {
  const Scene scene = shapes_.sceneOf(cell);
  RenderSettings settings = settingsOf(column, pixels);
  if (column.fromSecond) return valuesOf(maker_.render(scene, settings, progress), "");
  const bool makesWhole = column.method == Method::kHierarchical || column.method == Method::kDipole ||
                          column.method == Method::kVolume;
  RenderSettings whole = settings;
  whole.aovs = {"radiosity"};
  whole.components.multiple = !makesWhole;
  if (column.method == Method::kVolume && column.passes == 0)
    return valuesOf(solved(scene, column, 1, progress).picture(whole, progress), "radiosity");
  if (makesWhole) return valuesOf(maker_.render(scene, whole, progress), "radiosity");
  // A method that only gives radiance: back to radiosity by the exit lobe, which a judge's picture tells.
  Values values = valuesOf(maker_.render(scene, settings, progress), "");
  whole.method = Method::kHierarchical;
  const Image both = maker_.render(scene, whole, progress);
  for (size_t i = 0; i < values.size(); ++i) {
    const glm::vec3 L = both.rgb(i), B = both.rgb(i, "radiosity");
    const float lobe = (L.x + L.y + L.z) / std::max(B.x + B.y + B.z, 1e-30f);
    values[i] = lobe > 0 ? values[i] / lobe : glm::vec3(0);
  }
  return values;
}

}  // namespace lychnite::accuracy
