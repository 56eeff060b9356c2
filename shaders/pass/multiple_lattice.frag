// Multiple scattering on the paper's lattice: `adaptive` and `fixed`.
#include "pass/lattice_sampler.glsl"

uniform float piC;

layout(location = 0) out vec4 radiance;

void main() {
  Receiver receivers[4];
  int count = loadReceivers(ivec2(gl_FragCoord.xy) * 2, receivers);
  if (count == 0) discard;
  LightView view = lightView();
  vec3 sum = vec3(0.0);
  int i = 0;
  do {
    float cosO = clamp(dot(receivers[i].normal, receivers[i].view), 0.0, 1.0);
    sum += receivers[i].weight * exitLobe(cosO, eta, piC) * radiosity(view, receivers[i].position);
  } while (++i < count);
  radiance = vec4(sum, 0.0);
}
