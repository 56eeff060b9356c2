// Radiosity for every second pixel and row, where the surface between is smooth; multiple_matched.frag interpolates.
#include "pass/matched_sampler.glsl"

layout(location = 0) out vec4 coarseRadiosity;  // a: 1 where there is one
layout(location = 1) out vec4 coarseSurface;    // depth along the camera's axis, octahedral normal

void main() {
  Receiver receivers[4];
  // The four samples around the middle of 2 x 2 pixels.
  if (loadReceivers(ivec2(gl_FragCoord.xy) * 4 + 1, receivers) != 1 || receivers[0].weight < 1.0) discard;
  Receiver r = receivers[0];
  coarseRadiosity = vec4(litRadiosity(lightView(), r), 1.0);
  coarseSurface = vec4(dot(r.position - cameraPosition, cameraForward), octEncode(r.normal), 0.0);
}
