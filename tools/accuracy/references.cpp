#include "references.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "lychnite/base/error.h"
#include "lychnite/image/io.h"
#include "lychnite/reference/surface_walk.h"

namespace lychnite::accuracy {

namespace {

constexpr double kTooNoisy = 1.5;  // over what was asked for, to be made again

/// Standard error over mean, as the halves' difference tells it.
double noiseOf(const Halves& halves) {
  double squares = 0, sum = 0;
  for (size_t i = 0; i < halves[0].size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double a = double(halves[0][i][c]), b = double(halves[1][i][c]);
      squares += 0.5 * (a - b) * (a - b);
      sum += 0.5 * (a + b);
    }
  return sum > 0 ? std::sqrt(squares * 3 * double(halves[0].size())) / sum : 0;
}

}  // namespace

std::optional<std::filesystem::file_time_type> References::madeAt(const Cell& cell, int pixels) const {
  std::vector<std::filesystem::path> files{surfacePath(cell)};
  if (pixels > 0) files = {picturePath(cell, pixels, 0), picturePath(cell, pixels, 1)};
  auto newest = std::filesystem::file_time_type::min();
  for (const auto& file : files) {
    if (!std::filesystem::exists(file)) return {};
    newest = std::max(newest, std::filesystem::last_write_time(file));
  }
  return newest;
}

void References::makeSurface(const Cell& cell, const Progress& progress) const {
  const SurfaceWalkResult walk =
      surfaceWalk(shapes_.sceneOf(cell),
                  {.patches = kPatches, .timeLimit = budget_.seconds, .noise = budget_.noise}, progress);
  Image image(int(kPatches), 2);  // a row for each half, a pixel for each patch
  for (size_t half : {0, 1})
    for (size_t i = 0; i < kPatches; ++i)
      image.setRgb(half * kPatches + i, glm::vec3(walk.radiosity[half][0][i]));
  image.metadata["photons"] = fmt::format("{}", walk.photons);
  image.metadata["noise"] = fmt::format("{:.4g}", walk.noise);
  image.metadata["seconds"] = fmt::format("{:.2f}", walk.seconds);
  writeExr(image, surfacePath(cell));
}

Halves References::readSurface(const Cell& cell) const {
  const Image image = readImage(surfacePath(cell));
  if (image.width() != int(kPatches) || image.height() != 2)
    throw Error({.where = surfacePath(cell).string(),
                 .expected = fmt::format("{} x 2 pixels", kPatches),
                 .found = fmt::format("{} x {}", image.width(), image.height()),
                 .todo = "remove the file, so that it is made again"});
  Halves halves;
  for (size_t half : {0, 1})
    for (size_t i = 0; i < kPatches; ++i) halves[half].push_back(image.rgb(half * kPatches + i));
  return halves;
}

bool References::isTooNoisy(const Cell& cell) const {
  if (!madeAt(cell, 0)) return true;
  const Image image = readImage(surfacePath(cell));
  const auto seconds = image.metadata.find("seconds");
  if (seconds != image.metadata.end() && std::strtod(seconds->second.c_str(), nullptr) >= budget_.seconds)
    return false;
  return noiseOf(readSurface(cell)) > kTooNoisy * budget_.noise;
}

Halves References::surface(const Cell& cell, const Progress& progress) {
  if (!madeAt(cell, 0)) makeSurface(cell, progress);
  return readSurface(cell);
}

std::filesystem::path References::picturePath(const Cell& cell, int pixels, int half) const {
  return folder_ / fmt::format("{}-{}-{}.exr", cell.name(), pixels, half);
}

Image References::pictureHalf(const Cell& cell, int pixels, int half, const Progress& progress) {
  const std::filesystem::path path = picturePath(cell, pixels, half);
  if (std::filesystem::exists(path)) return readImage(path);
  RenderSettings settings;
  settings.width = settings.height = pixels;
  settings.method = Method::kWalk;
  settings.components = {.multiple = true, .single = false, .surface = false};
  settings.aovs = {"radiosity"};
  settings.seed = uint64_t(half) + 1;
  settings.timeLimit = budget_.seconds / 2;
  settings.noise = budget_.noise;
  Image image = maker_.render(shapes_.sceneOf(cell), settings, progress);
  if (image.metadata.contains("interrupted")) throw Interrupted();
  writeExr(image, path);
  return image;
}

PictureTruth References::picture(const Cell& cell, int pixels, const Progress& progress) {
  PictureTruth truth;
  for (int half : {0, 1}) truth.half[half] = pictureHalf(cell, pixels, half, progress);
  return truth;
}

}  // namespace lychnite::accuracy
