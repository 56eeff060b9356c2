// Multiple scattering by the matched sampler, first part: what can be interpolated from the next coarser level, and the list
// of the receivers that cannot.
#include "lib/profile.glsl"
#include "lists/matched_sites.glsl"

uniform sampler2D coarserValue;    // as `value` and `surface` below, evaluated
uniform sampler2D coarserSurface;
uniform float interpolation;       // largest relative difference between neighbours that is interpolated across
uniform float coreLength;          // of the profile: what lies nearer together differs smoothly
uniform int hasCoarser;
uniform int firstRow;              // of the sites drawn here
uniform vec3 faint;                // radiosity whose differences do not show

layout(std430) buffer Sites {
  uint siteCount;
  uint sites[];
};

layout(location = 0) out vec4 value;    // the interpolated part
layout(location = 1) out vec4 surface;  // depth along the camera's axis, octahedral normal, 1 + bits of the listed receivers

const float kMostTolerance = 2.0;

// Neighbours on the receiver's own piece of surface: normals within about 18 degrees, points near its tangent plane.
bool sameSurface(Receiver r, ivec2 at, vec3 s, out float far) {
  vec2 middle = vec2(at * (4 << level) + (2 << level));
  vec3 offset = cameraPosition + rayThrough(middle) * s.x - r.position;
  far = length(offset);
  return dot(octDecode(s.yz), r.normal) > 0.95 && abs(dot(offset, r.normal)) <= 0.25 * far;
}

// Across neighbours that differ little, the more the nearer they are, or by nothing that shows beside what a lit surface
// gives.
bool interpolated(Receiver r, ivec2 site, out vec3 radiosity) {
  vec2 t = vec2(site) * 0.5 - 0.25;
  ivec2 base = ivec2(floor(t));
  ivec2 last = textureSize(coarserValue, 0) - 1;
  vec2 f = t - vec2(base);
  radiosity = vec3(0.0);
  vec3 least = vec3(1e30);
  vec3 most = vec3(0.0);
  float farthest = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 corner = ivec2(i & 1, i >> 1);
    ivec2 at = base + corner;
    if (at.x < 0 || at.y < 0 || at.x > last.x || at.y > last.y) return false;
    vec4 s = texelFetch(coarserSurface, at, 0);
    float far;
    if (s.w == 0.0 || !sameSurface(r, at, s.xyz, far)) return false;
    farthest = max(farthest, far);
    vec3 c = texelFetch(coarserValue, at, 0).xyz;
    vec2 w = mix(1.0 - f, f, vec2(corner));
    radiosity += w.x * w.y * c;
    least = min(least, c);
    most = max(most, c);
  }
  float allowed = interpolation * clamp(coreLength / farthest, 1.0, kMostTolerance);
  return all(lessThanEqual(most - least, allowed * max(most, faint)));
}

void main() {
  ivec2 site = ivec2(gl_FragCoord.xy) + ivec2(0, firstRow);
  Receiver receivers[4];
  int count = loadReceivers(firstSample(site), receivers);
  if (count == 0 || (level > 0 && (count > 1 || receivers[0].weight < 1.0))) discard;
  vec3 sum = vec3(0.0);
  int listed = 0;
  for (int i = 0; i < count; ++i) {
    vec3 radiosity;
    if (hasCoarser == 1 && interpolated(receivers[i], site, radiosity)) {
      sum += shownAs(receivers[i]) * radiosity;
    } else {
      sites[atomicAdd(siteCount, 1u)] = packReceiver(site, i);
      listed |= 1 << i;
    }
  }
  value = vec4(sum, 0.0);
  Receiver r = receivers[0];
  surface = vec4(dot(r.position - cameraPosition, cameraForward), octEncode(r.normal), 1.0 + float(listed));
}
