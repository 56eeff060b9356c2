// Multiple scattering on the paper's lattice (Yao & Wang 2009 eq. 4 to 10) around the projection of the receiver. As
// printed, the cell's projected area is multiplied by (w_i . n) once more than the flux asks for; docs/physics.md.
#include "lib/fresnel.glsl"
#include "lib/profile.glsl"
#include "pass/light_view.glsl"
#include "pass/receiver.glsl"

uniform sampler2D map;     // LAYOUT 2: depth and cosine; LAYOUT 5: normal and irradiance
#if LAYOUT == 5
uniform sampler2D mapDepth;
#endif
uniform sampler2D profile;
uniform float profileScale;
uniform vec4 lattice[49];  // offset in texels (x, y), level, area in level-0 texels
uniform float eta;
uniform float piC;

layout(location = 0) out vec4 radiance;

vec3 radiosity(LightView view, vec3 receiver) {
  vec2 size = vec2(textureSize(map, 0));
  vec2 centre = vec2(projectToMap(view, receiver));
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 49; ++i) {
    vec2 uv = centre + lattice[i].xy / size;
    if (uv.x < 0.0 || uv.y < 0.0 || uv.x > 1.0 || uv.y > 1.0) continue;
    vec4 s = textureLod(map, uv, lattice[i].z);
#if LAYOUT == 2
    float depth = s.x;
    float cosine = s.y;
    if (cosine <= 0.0) continue;
    vec3 p = unprojectFromMap(view, uv, depth);
    vec3 irradiance = facingIrradiance(view, lightPower, p);
#else
    if (s.w <= 0.0) continue;
    float depth = textureLod(mapDepth, uv, lattice[i].z).x;
    vec3 p = unprojectFromMap(view, uv, depth);
    float cosine = max(0.0, -dot(lightTravel(view, p), s.xyz));
    vec3 irradiance = lightPower * s.w;
#endif
    float area = windowArea(view, p, depth) / (size.x * size.y) * lattice[i].w;
    float entering = cosine * (1.0 - fresnelReflectance(min(1.0, cosine), eta)) * area;
    vec3 Rd = textureLod(profile, vec2(profileCoordinate(distance(p, receiver), profileScale), 0.25), 0.0).xyz;
    sum += Rd * irradiance * entering;
  }
  return sum;
}

void main() {
  Receiver receivers[4];
  int count = loadReceivers(ivec2(gl_FragCoord.xy) * 2, receivers);
  if (count == 0) discard;
  LightView view = lightView();
  vec3 sum = vec3(0.0);
  for (int i = 0; i < count; ++i) {
    float cosO = clamp(dot(receivers[i].normal, receivers[i].view), 0.0, 1.0);
    sum += receivers[i].weight * exitLobe(cosO, eta, piC) * radiosity(view, receivers[i].position);
  }
  radiance = vec4(sum, 0.0);
}
