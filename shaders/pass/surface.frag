// The coat (and the base of an opaque object) with a filtered shadow test in the light-space map.
#include "lib/fresnel.glsl"
#include "lib/surface.glsl"
#include "pass/light_view.glsl"
#include "pass/receiver.glsl"

uniform sampler2D map;  // depth first
uniform vec3 base;
uniform float eta;
uniform float roughness;
uniform float piC;

layout(location = 0) out vec4 radiance;

// Share of the light that reaches the receiver: percentage-closer filtering (Reeves et al. 1987) with a 3 x 3 tent,
// the point moved off the surface by what a texel's slope can hide.
float visibility(LightView view, Receiver r, float cosI) {
  vec2 size = vec2(textureSize(map, 0));
  float texel = 2.0 * view.halfWidth * mix(1.0, projectToMap(view, r.position).z, view.perspective) / size.x;
  float slope = sqrt(max(0.0, 1.0 - cosI * cosI));
  vec3 m = projectToMap(view, r.position + r.normal * (texel * (0.5 + 2.5 * slope)));
  // Outside of the window (a point light close to a wide opaque object) nothing is known to block the light.
  if (m.z <= 0.0 || m.x < 0.0 || m.y < 0.0 || m.x > 1.0 || m.y > 1.0) return 1.0;
  vec2 t = m.xy * size - 0.5;
  vec2 f = fract(t);
  ivec2 first = ivec2(floor(t)) - 1;
  float lit = 0.0;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      float wx = x == 0 ? 1.0 - f.x : (x == 3 ? f.x : 1.0);
      float wy = y == 0 ? 1.0 - f.y : (y == 3 ? f.y : 1.0);
      ivec2 at = clamp(first + ivec2(x, y), ivec2(0), ivec2(size) - 1);
      if (m.z <= texelFetch(map, at, 0).x + 0.5 * texel) lit += wx * wy;
    }
  }
  return lit / 9.0;
}

void main() {
  Receivers all = loadReceivers(ivec2(gl_FragCoord.xy) * 2);
  if (all.count == 0) discard;
  LightView view = lightView();
  vec3 sum = vec3(0.0);
  Receiver r = all.first;
  int i = 0;
  do {
    vec3 wi = -lightTravel(view, r.position);
    vec3 response = surfaceResponse(base, eta, roughness, piC, r.normal, r.view, wi);
    if (response.x + response.y + response.z > 0.0)
      sum += r.weight * visibility(view, r, dot(r.normal, wi)) * response *
             facingIrradiance(view, lightPower, r.position);
    r = nextReceiver(all, ++i);
  } while (i < all.count);
  radiance = vec4(sum, 0.0);
}
