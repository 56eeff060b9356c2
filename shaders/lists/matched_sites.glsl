// Where the matched sampler is evaluated. A level's sites are the blocks of 2^level x 2^level pixels, each with a receiver in
// its middle, or at level 0 the pixels with up to four. A site's receivers that cannot be interpolated from the next coarser
// level are listed, so that they are evaluated side by side however thinly they lie in the picture; those that need as many
// cells as each other in one list, so that none waits for its neighbours.
#include "lib/fresnel.glsl"
#include "pass/light_view.glsl"
#include "pass/receiver.glsl"
#include "pass/refinement.glsl"

uniform int level;
uniform float eta;
uniform float piC;

const int kLists = 2 * MOST_REFINEMENT + 1;
const uint kGroup = 64u;  // receivers evaluated by one group

layout(std430) buffer Sites {
  uvec3 grid;           // of groups: columns, GROUP_ROWS, 1
  uint groups;          // that the lists fill
  uint counts[kLists];
  uint sites[];         // the lists, listLength places each
};
uniform int listLength;

// The first of the 2 x 2 samples in the middle of a block.
ivec2 firstSample(ivec2 site) { return level == 0 ? site * 2 : site * (2 << level) + ((1 << level) - 1); }

uint packReceiver(ivec2 site, int receiver) { return uint(site.x) | uint(site.y) << 15 | uint(receiver) << 30; }
ivec2 siteOf(uint code) { return ivec2(code & 0x7fffu, code >> 15 & 0x7fffu); }
int receiverOf(uint code) { return int(code >> 30); }

// What the receiver's radiosity is multiplied with: in a picture the exit lobes of its samples, a quarter of the pixel each.
float shownAs(Receiver r) {
  if (level > 0) return 1.0;
  float sum = 0.0;
  for (int i = 0; i < 4; ++i)
    if (float(i) < 4.0 * r.weight) sum += exitLobe(r.cosO[i], eta, piC);
  return 0.25 * sum;
}
