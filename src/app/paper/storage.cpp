// Bytes of the light-space map per method.
#include <fmt/format.h>

#include "app/paper/parts.h"
#include "lychnite/optics/materials.h"

namespace lychnite::paper {
namespace {

constexpr int kMapSizes[] = {256, 512, 1024};

struct Layout {
  Method method;
  const char* holds;
  int channels;
};
// What a texel of the map for multiple scattering holds, and with a mip chain.
constexpr Layout kLayouts[] = {
    {Method::kFixed, "depth, normal, irradiance [Dachsbacher and Stamminger 2003]", 5},
    {Method::kAdaptive, "depth and cosine (the paper)", 2},
    {Method::kMatched, "flux and its first three depth moments (ours)", 4}};

/// Of all levels of a square texture of 32-bit floats.
double chainBytes(int size, int channels) {
  double texels = 0;
  for (int side = size; side > 0; side /= 2) texels += double(side) * side;
  return texels * channels * 4;
}

}  // namespace

int storageSteps(const Studio&) {
  return 1;
}

void makeStorage(Studio& studio, Report& report) {
  Table table{.name = "storage",
              .caption =
                  "Bytes of the light-space map that multiple scattering is summed from, 32-bit floats with "
                  "mip levels, for one light and one object. MB are 10^6 bytes.",
              .columns = {{"method", "method"},
                          {"a texel holds", "holds"},
                          {"channels", "channels", 0},
                          {"map", "map_size", 0},
                          {"MB", "map_bytes", 2, 1e-6},
                          {"MB as half floats", "half_float_bytes", 2, 1e-6}}};
  for (const Layout& layout : kLayouts)
    for (const int size : kMapSizes)
      table.rows.push_back({methodName(layout.method), layout.holds, double(layout.channels), double(size),
                            chainBytes(size, layout.channels), chainBytes(size, layout.channels) / 2});
  report.blocks.push_back(table);
  studio.step("storage");
  report.differs =
      "The paper counts channels (two instead of five) and no bytes. Ours takes four: what the third and "
      "fourth buy is "
      "measured in docs/sampling.md.";
}

}  // namespace lychnite::paper
