#include <functional>
#include <glm/mat4x4.hpp>
#include <vector>

#include "app/bench_growth.h"
#include "app/bench_timer.h"
#include "gpu/framebuffer.h"
#include "gpu/pass.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "gpu/vertex_array.h"

namespace lychnite::bench {
namespace {

constexpr int kFetches = 49;

/// How often a second `work` is done, by the fastest of three runs of about `seconds` each.
double perSecond(gpu::Context& context, double seconds, const std::function<void()>& work) {
  work();
  context.finish();
  double best = 0;
  for (int run = 0; run < 3; ++run) {
    const double start = wallMs();
    int times = 0;
    do {
      work();
      context.finish();
      ++times;
    } while (wallMs() - start < seconds * 1000);
    best = std::max(best, 1000 * times / (wallMs() - start));
  }
  return best;
}

gpu::Program fetchProgram(int kind) {
  return gpu::Program({.label = "fetch rate",
                       .vertex = "pass/full_screen.vert",
                       .fragment = "bench/fetch.frag",
                       .defines = {{"FETCHES", std::to_string(kFetches)}, {"KIND", std::to_string(kind)}}});
}

gpu::Texture mapTexture() {
  constexpr int kSize = 512;
  gpu::Texture texture({.label = "fetch rate",
                        .format = gpu::Format::kRgba32f,
                        .width = kSize,
                        .height = kSize,
                        .levels = 0,
                        .filter = gpu::Filter::kLinearMipLinear});
  texture.upload(std::vector<float>(size_t(kSize) * kSize * 4, 0.5f));
  texture.generateMipmaps();
  return texture;
}

/// A flat sheet of about that many triangles.
void fillSheet(gpu::VertexArray& sheet, int side) {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::uvec3> triangles;
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x) positions.emplace_back(float(x) / float(side), float(y) / float(side), 0);
  normals.assign(positions.size(), {0, 0, 1});
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto at = uint32_t(y * (side + 1) + x), up = uint32_t(at + uint32_t(side) + 1);
      triangles.emplace_back(at, at + 1, up);
      triangles.emplace_back(at + 1, up + 1, up);
    }
  sheet.setPositions(positions);
  sheet.setNormals(normals);
  sheet.setTriangles(triangles);
}

}  // namespace

BenchLimits measureLimits(gpu::Context& context, bool quick) {
  context.makeCurrent();
  const double seconds = quick ? 0.05 : 0.5;
  const int pictureSide = quick ? 150 : 600, sheetSide = quick ? 100 : 707;
  const gpu::Texture picture(
      {.label = "limits", .format = gpu::Format::kRgba32f, .width = pictureSide, .height = pictureSide});
  gpu::Framebuffer target({.label = "limits", .colours = {picture}});
  const double pixels = double(pictureSide) * pictureSide;
  BenchLimits limits;
  const gpu::Texture map = mapTexture();
  const auto fetchRate = [&](int kind, double level) {
    gpu::Program program = fetchProgram(kind);
    program.setTexture("map", map);
    program.set("level", level);
    return pixels * kFetches * perSecond(context, seconds, [&] {
             gpu::Pass pass("fetch rate", target);
             pass.drawFullScreen(program);
           });
  };
  limits.nearestFetches = fetchRate(0, 0);
  limits.bilinearFetches = fetchRate(1, 1);
  limits.trilinearFetches = fetchRate(1, 1.5);
  gpu::Program fill({.label = "fill rate", .vertex = "pass/full_screen.vert", .fragment = "bench/fill.frag"});
  constexpr int kLayers = 8;
  limits.pixels = kLayers * pixels * perSecond(context, seconds, [&] {
                    gpu::Pass pass("fill rate", target);
                    for (int i = 0; i < kLayers; ++i) pass.drawFullScreen(fill);
                  });
  gpu::Program vertex({.label = "vertex rate", .vertex = "bench/vertex.vert", .fragment = "bench/fill.frag"});
  vertex.set("toClip", glm::mat4(1));
  gpu::VertexArray sheet("vertex rate");
  fillSheet(sheet, sheetSide);
  const double sheets = perSecond(context, seconds, [&] {
    gpu::Pass pass("vertex rate", target);
    pass.drawMesh(vertex, sheet);
  });
  limits.vertices = sheets * (sheetSide + 1.0) * (sheetSide + 1.0);
  limits.triangles = sheets * 2.0 * sheetSide * sheetSide;
  return limits;
}

}  // namespace lychnite::bench
