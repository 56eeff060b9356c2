// Multiple scattering by the matched sampler, second part: the listed receivers.
#include "pass/matched_sampler.glsl"
#include "lists/matched_sites.glsl"

layout(local_size_x = 64) in;  // kGroup

// Of a coarse level its values; of a picture four rows for each, one for each receiver of a pixel.
layout(rgba32f) writeonly uniform image2D evaluated;
uniform int firstRow;

void main() {
  LightView view = lightView();
  // A software driver gives each core groups in a row: next to each other in the lists are those of different rows.
  uint group = gl_WorkGroupID.x * uint(GROUP_ROWS) + gl_WorkGroupID.y;
  int list = 0;
  for (; list < kLists; ++list) {
    uint filled = (counts[list] + kGroup - 1u) / kGroup;
    if (group < filled) break;
    group -= filled;
  }
  uint place = group * kGroup + gl_LocalInvocationID.x;
  if (list == kLists || place >= counts[list]) return;
  uint code = sites[uint(list * listLength) + place];
  ivec2 site = siteOf(code);
  int number = receiverOf(code);
  ivec2 at = level > 0 ? site : ivec2(site.x, (site.y - firstRow) * 4 + number);
  Receivers all = loadReceivers(firstSample(site));
  // Another program listed it: a compiler may round the decision which samples share a receiver otherwise there. Then the
  // first stands for all.
  if (number >= all.count) {
    imageStore(evaluated, at, vec4(0.0));
    return;
  }
  Receiver r = all.first;
  if (number > 0) r = nextReceiver(all, number);
  imageStore(evaluated, at, vec4(shownAs(r) * litRadiosity(view, r), 0.0));
}
