// Multiple scattering by the matched sampler. It varies slowly over a smooth surface: there it is interpolated between
// the coarse evaluations of multiple_matched_coarse.frag, elsewhere evaluated for the pixel itself.
#include "pass/matched_sampler.glsl"

uniform sampler2D coarseRadiosity;
uniform sampler2D coarseSurface;
uniform float interpolation;  // largest relative difference between neighbours that is interpolated across; 0 never
uniform float eta;
uniform float piC;

layout(location = 0) out vec4 radiance;

// Neighbours on the receiver's own piece of surface: normals within about 18 degrees, points near its tangent plane.
bool sameSurface(Receiver r, ivec2 at) {
  vec3 s = texelFetch(coarseSurface, at, 0).xyz;
  vec3 offset = cameraPosition + rayThrough(vec2(at) * 4.0 + 2.0) * s.x - r.position;
  return dot(octDecode(s.yz), r.normal) > 0.95 && abs(dot(offset, r.normal)) <= 0.25 * length(offset);
}

// Across neighbours that differ little, or by nothing that shows beside what a lit surface gives.
bool interpolated(Receiver r, vec3 faint, out vec3 value) {
  vec2 t = gl_FragCoord.xy * 0.5 - 0.5;
  ivec2 base = ivec2(floor(t));
  ivec2 last = textureSize(coarseRadiosity, 0) - 1;
  vec2 f = t - vec2(base);
  value = vec3(0.0);
  vec3 least = vec3(1e30);
  vec3 most = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 corner = ivec2(i & 1, i >> 1);
    ivec2 at = base + corner;
    if (at.x < 0 || at.y < 0 || at.x > last.x || at.y > last.y) return false;
    vec4 c = texelFetch(coarseRadiosity, at, 0);
    if (c.w == 0.0 || !sameSurface(r, at)) return false;
    vec2 w = mix(1.0 - f, f, vec2(corner));
    value += w.x * w.y * c.xyz;
    least = min(least, c.xyz);
    most = max(most, c.xyz);
  }
  return all(lessThanEqual(most - least, interpolation * max(most, faint)));
}

void main() {
  Receiver receivers[4];
  int count = loadReceivers(ivec2(gl_FragCoord.xy) * 2, receivers);
  if (count == 0) discard;
  LightView view = lightView();
  vec3 faint = 0.01 * profileP(0.0) * lightPower;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < count; ++i) {
    Receiver r = receivers[i];
    float cosO = clamp(dot(r.normal, r.view), 0.0, 1.0);
    vec3 value;
    if (interpolation == 0.0 || !interpolated(r, faint, value)) value = litRadiosity(view, r);
    sum += r.weight * exitLobe(cosO, eta, piC) * value;
  }
  radiance = vec4(sum, 0.0);
}
