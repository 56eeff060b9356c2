// Multiple scattering by the matched sampler, first part: what can be interpolated from the next coarser level, and the list
// of the receivers that cannot.
#include "lists/matched_sites.glsl"

uniform sampler2D coarserValue;    // as `value` and `surface` below, evaluated
uniform sampler2D coarserSurface;
uniform float interpolation;       // largest relative difference between neighbours that is interpolated across
uniform float coreLength;          // of the profile: what lies nearer together differs smoothly
uniform int hasCoarser;
uniform vec3 faint;                // radiosity whose differences do not show

layout(location = 0) out vec4 value;    // the interpolated part
layout(location = 1) out vec4 surface;  // depth along the camera's axis, octahedral normal, 1 + bits of the listed receivers; of
                                        // pixels, whose surface nobody asks for, the bits alone

const float kMostTolerance = 2.0;
// What a straight line between neighbours may be wrong by, as a share of the difference that needs no such look.
const float kBend = 0.2;

// Neighbours on the receiver's own piece of surface: normals within about 18 degrees, points near its tangent plane; both
// looser the nearer they are beside the core.
bool sameSurface(Receiver r, ivec2 at, vec3 s, out float far) {
  vec2 middle = vec2(at * (4 << level) + (2 << level));
  vec3 offset = cameraPosition + rayThrough(middle) * s.x - r.position;
  far = length(offset);
  float strict = clamp(far / coreLength, 0.0, 1.0);
  return dot(octDecode(s.yz), r.normal) > mix(0.8, 0.95, strict) &&
         abs(dot(offset, r.normal)) <= mix(0.5, 0.25, strict) * far;
}

// Value and distance of a coarser site; false where there is none or it lies on another piece of surface.
bool neighbour(Receiver r, ivec2 at, out vec3 found, out float far, out bool evaluated) {
  evaluated = true;
  found = vec3(0.0);
  far = 0.0;
  ivec2 last = textureSize(coarserValue, 0) - 1;
  if (at.x < 0 || at.y < 0 || at.x > last.x || at.y > last.y) return false;
  vec4 s = texelFetch(coarserSurface, at, 0);
  if (s.w == 0.0 || !sameSurface(r, at, s.xyz, far)) return false;
  found = texelFetch(coarserValue, at, 0).xyz;
  evaluated = s.w > 1.0;
  return true;
}

// Whether a straight line through the corners is near enough: their second differences with their neighbours in the cell and
// beyond, times what a parabola a quarter of the way between sites then lies off. Where the surface ends beyond, or another
// begins, the values seldom are straight.
bool straight(ivec2 base, vec3 corners[4], vec3 allowed) {
  ivec2 last = textureSize(coarserValue, 0) - 1;
  vec3 bend = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 corner = ivec2(i & 1, i >> 1);
    vec3 here = vec3(0.0);
    for (int axis = 0; axis < 2; ++axis) {
      ivec2 step = axis == 0 ? ivec2(2 * corner.x - 1, 0) : ivec2(0, 2 * corner.y - 1);
      vec3 outer = texelFetch(coarserValue, clamp(base + corner + step, ivec2(0), last), 0).xyz;
      here += abs(outer - 2.0 * corners[i] + corners[i ^ (axis + 1)]);
    }
    bend = max(bend, here);
  }
  return all(lessThanEqual(0.09375 * bend, allowed));
}

// Across neighbours that differ little, the more the nearer they are, or by nothing that shows beside what a lit surface
// gives, or that lie on a straight line.
bool interpolated(Receiver r, ivec2 site, out vec3 found) {
  vec2 t = vec2(site) * 0.5 - 0.25;
  ivec2 base = ivec2(floor(t));
  vec2 f = t - vec2(base);
  found = vec3(0.0);
  vec3 least = vec3(1e30);
  vec3 most = vec3(0.0);
  float farthest = 0.0;
  bool settled = true;  // all of them interpolated: what lies between them is as straight
  vec3 corners[4];
  for (int i = 0; i < 4; ++i) {
    ivec2 corner = ivec2(i & 1, i >> 1);
    float far;
    bool evaluated;
    if (!neighbour(r, base + corner, corners[i], far, evaluated)) return false;
    settled = settled && !evaluated;
    farthest = max(farthest, far);
    vec2 w = mix(1.0 - f, f, vec2(corner));
    found += w.x * w.y * corners[i];
    least = min(least, corners[i]);
    most = max(most, corners[i]);
  }
  float allowed = interpolation * clamp(coreLength / farthest, 1.0, kMostTolerance);
  bool good = settled || all(lessThanEqual(most - least, allowed * max(most, faint)));
  return good || straight(base, corners, kBend * interpolation * max(most, faint));
}

// Adds a receiver to the list of its number of cells: of one pattern, or of it and the next finer.
void enlist(Receiver r, ivec2 site, int number) {
  float refinement = refinementOf(dot(r.normal, lightTravel(lightView(), r.position)));
  int list = clamp(2 * int(refinement) + (fract(refinement) > kFadeFrom ? 1 : 0), 0, kLists - 1);  // NaN
  uint place = atomicAdd(counts[list], 1u);
  sites[uint(list * listLength) + place] = packReceiver(site, number);
  if (place % kGroup == 0u && atomicAdd(groups, 1u) % uint(GROUP_ROWS) == 0u) atomicAdd(grid.x, 1u);
}

void main() {
  ivec2 site = ivec2(gl_FragCoord.xy);
  Receivers all = loadReceivers(firstSample(site));
  if (all.count == 0 || (level > 0 && all.count > 1)) discard;
  vec3 sum = vec3(0.0);
  int listed = 0;
  // Its condition last: a software driver runs the whole body before it sees that nobody is left in it.
  Receiver r = all.first;
  int i = 0;
  do {
    vec3 found;
    if (hasCoarser == 1 && interpolated(r, site, found)) {
      sum += shownAs(r) * found;
    } else {
      enlist(r, site, i);
      listed |= 1 << i;
    }
    r = nextReceiver(all, ++i);
  } while (i < all.count);
  value = vec4(sum, 0.0);
  float depth = dot(all.first.position - cameraPosition, cameraForward);
  surface = level > 0 ? vec4(depth, octEncode(all.first.normal), 1.0 + float(listed)) : vec4(float(listed));
}
