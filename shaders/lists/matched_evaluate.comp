// Multiple scattering by the matched sampler, second part: the listed receivers.
#include "pass/matched_sampler.glsl"
#include "lists/matched_sites.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer Sites {
  uint siteCount;
  uint sites[];
};
// Of a coarse level its values; of a picture four rows for each, one for each receiver of a pixel.
layout(rgba32f) writeonly uniform image2D evaluated;
uniform int firstRow;

void main() {
  LightView view = lightView();
  // A software driver gives each core groups in a row: their numbers' bits are turned round, so that the list's beginning is
  // not one core's alone.
  uint group = bitfieldReverse(gl_WorkGroupID.x) >> (32 - GROUP_BITS);
  uint step = gl_WorkGroupSize.x << GROUP_BITS;
  for (uint i = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x; i < siteCount; i += step) {
    Receiver receivers[4];
    ivec2 site = siteOf(sites[i]);
    int number = receiverOf(sites[i]);
    // Another program listed it: a compiler may round the decision which samples share a receiver otherwise there.
    int count = loadReceivers(firstSample(site), receivers);
    Receiver r = receivers[clamp(number, 0, max(count, 1) - 1)];
    ivec2 at = level > 0 ? site : ivec2(site.x, (site.y - firstRow) * 4 + number);
    imageStore(evaluated, at, vec4(shownAs(r) * litRadiosity(view, r), 0.0));
  }
}
