// Multiple scattering on the paper's lattice: `adaptive` and `fixed`.
#include "pass/lattice_sampler.glsl"

uniform float piC;

layout(location = 0) out vec4 radiance;

void main() {
  Receivers all = loadReceivers(ivec2(gl_FragCoord.xy) * 2);
  if (all.count == 0) discard;
  LightView view = lightView();
  vec3 sum = vec3(0.0);
  Receiver r = all.first;
  int i = 0;
  do {
    float cosO = clamp(dot(r.normal, r.view), 0.0, 1.0);
    sum += r.weight * exitLobe(cosO, eta, piC) * radiosity(view, r.position);
    r = nextReceiver(all, ++i);
  } while (i < all.count);
  radiance = vec4(sum, 0.0);
}
