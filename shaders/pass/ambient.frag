// What a uniform surrounding of radiance `ambient` adds, unoccluded: the half-space answer, and its mirror image.
#include "lib/fresnel.glsl"
#include "pass/receiver.glsl"

uniform vec3 ambient;
uniform vec3 reflectance;  // of what lies under the coat, for light that has entered
uniform float eta;
uniform float piC;

layout(location = 0) out vec4 radiance;

void main() {
  Receivers all = loadReceivers(ivec2(gl_FragCoord.xy) * 2);
  if (all.count == 0) discard;
  vec3 sum = vec3(0.0);
  Receiver r = all.first;
  int i = 0;
  do {
    float cosO = clamp(dot(r.normal, r.view), 0.0, 1.0);
    float mirrored = fresnelReflectance(cosO, eta);
    sum += r.weight * (vec3(mirrored) + reflectance * piC * exitLobe(cosO, eta, piC));
    r = nextReceiver(all, ++i);
  } while (i < all.count);
  radiance = vec4(sum * ambient, 0.0);
}
