// Single scattering along the refracted eye ray, up to 256 samples, the light's path from the light-space map.
#include "lib/fresnel.glsl"
#include "lib/phase.glsl"
#include "lib/single.glsl"
#include "pass/light_view.glsl"
#include "pass/receiver.glsl"

uniform sampler2D map;       // depth and cosine
uniform sampler2D farDepth;
uniform int sampleCount;
uniform vec3 sigma_s;        // per scene unit
uniform vec3 sigma_t;
uniform float g;
uniform float eta;
uniform vec3 boundCentre;
uniform float boundRadius;

layout(location = 0) out vec4 radiance;

struct Entry {
  float depth;     // mean over the lit texels around
  float cosine;
  float farthest;
  float lit;       // bilinear share of lit texels
};

// The four texels around uv; background and occluders carry no cosine and must not bend the depth.
Entry entryAt(vec2 uv) {
  vec2 size = vec2(textureSize(map, 0));
  vec2 t = uv * size - 0.5;
  vec2 f = fract(t);
  ivec2 base = ivec2(floor(t));
  Entry e = Entry(0.0, 0.0, 0.0, 0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 o = ivec2(i & 1, i >> 1);
    ivec2 texel = base + o;
    if (texel.x < 0 || texel.y < 0 || texel.x >= int(size.x) || texel.y >= int(size.y)) continue;
    vec2 s = texelFetch(map, texel, 0).xy;
    if (s.y <= 0.0) continue;
    float w = (o.x == 1 ? f.x : 1.0 - f.x) * (o.y == 1 ? f.y : 1.0 - f.y);
    e.depth += w * s.x;
    e.cosine += w * s.y;
    e.farthest += w * texelFetch(farDepth, texel, 0).x;
    e.lit += w;
  }
  if (e.lit > 0.0) {
    e.depth /= e.lit;
    e.cosine /= e.lit;
    e.farthest /= e.lit;
  }
  return e;
}

// In-scattered radiance towards the receiver from the point at distance s along its refracted ray, without the eye
// path's attenuation.
vec3 inScattered(LightView view, vec3 p, vec3 travel) {
  vec3 m = projectToMap(view, p);
  Entry e = entryAt(vec2(m));
  if (e.lit <= 0.0) return vec3(0.0);
  float texel = 2.0 * view.halfWidth * mix(1.0, m.z, view.perspective) / float(textureSize(map, 0).x);
  // A texel of slack each way: the depths are means over a texel.
  if (m.z > e.farthest + texel || m.z < e.depth - 2.0 * texel) return vec3(0.0);
  vec3 lightDirection = lightTravel(view, p);
  float straight = depthToDistance(view, p, max(0.0, m.z - e.depth));
  float s = refractedDistance(straight, e.cosine, eta);
  float cosT = max(1e-4, refractedCosine(e.cosine, eta));
  // The refracted beam is wider or narrower than outside by cosT / cosI.
  float beam = (1.0 - fresnelReflectance(e.cosine, eta)) * e.cosine / cosT * e.lit;
  vec3 irradiance = facingIrradiance(view, lightPower, p);
  return irradiance * beam * exp(-sigma_t * s) * henyeyGreenstein(dot(lightDirection, -travel), g);
}

// Whether p lies between the surfaces nearest to and farthest from the light.
bool inside(LightView view, vec3 p) {
  vec3 m = projectToMap(view, p);
  vec2 size = vec2(textureSize(map, 0));
  if (m.x < 0.0 || m.y < 0.0 || m.x >= 1.0 || m.y >= 1.0) return false;
  ivec2 at = ivec2(m.xy * size);
  float texel = 2.0 * view.halfWidth * mix(1.0, m.z, view.perspective) / size.x;
  return m.z <= texelFetch(farDepth, at, 0).x && m.z >= texelFetch(map, at, 0).x - texel;
}

// Where the ray leaves the object, found by steps through its bounding sphere and bisection. Without it a few samples on a
// long ray through a small object would show as contours where one after the other falls outside.
float leaveObject(LightView view, vec3 o, vec3 d, float end) {
  float last = 0.0;
  for (int i = 1; i <= 12; ++i) {
    float t = end * float(i) / 12.0;
    if (!inside(view, o + d * t)) {
      float outside = t;
      for (int j = 0; j < 6; ++j) {
        float middle = 0.5 * (last + outside);
        if (inside(view, o + d * middle)) last = middle; else outside = middle;
      }
      return outside;
    }
    last = t;
  }
  return end;
}

vec3 singleScattering(LightView view, Receiver r) {
  float cosO = clamp(dot(r.normal, r.view), 0.0, 1.0);
  vec3 travel = refractInto(-r.view, r.normal, eta);
  float end = leaveSphere(r.position, travel, boundCentre, boundRadius);
  if (end <= 0.0) return vec3(0.0);
  // Beyond ten mean free paths nothing comes back.
  float slowest = min(sigma_t.x, min(sigma_t.y, sigma_t.z));
  end = leaveObject(view, r.position, travel, min(end, 10.0 / max(slowest, 1e-6)));
  // Placed for the channel that reaches farthest, so that no channel's weight can exceed 1; the others are weighted by
  // their own attenuation over the density, which is exact for each.
  vec3 sum = vec3(0.0);
  int k = 0;
  do {
    float u = (float(k) + 0.5) / float(sampleCount);
    float s = freePath(u, slowest, end);
    vec3 weight = exp(-sigma_t * s) / freePathDensity(s, slowest, end);
    sum += weight * inScattered(view, r.position + travel * s, travel);
  } while (++k < sampleCount);
  float leaving = (1.0 - fresnelReflectance(cosO, eta)) / (eta * eta);
  return sigma_s * sum * (leaving / float(sampleCount));
}

void main() {
  Receivers all = loadReceivers(ivec2(gl_FragCoord.xy) * 2);
  if (all.count == 0) discard;
  LightView view = lightView();
  vec3 sum = vec3(0.0);
  Receiver r = all.first;
  int i = 0;
  do {
    sum += r.weight * singleScattering(view, r);
    r = nextReceiver(all, ++i);
  } while (i < all.count);
  radiance = vec4(sum, 0.0);
}
