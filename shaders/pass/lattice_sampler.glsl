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

const int kCells = 49;

// One cell of the lattice as the receiver sees it.
struct Cell {
  vec2 uv;
  float level;
  float depth;   // of the lit surface there
  vec3 radiosity;
};

Cell cellOf(LightView view, vec3 receiver, vec2 centre, int i) {
  vec2 size = vec2(textureSize(map, 0));
  Cell c = Cell(centre + lattice[i].xy / size, lattice[i].z, 0.0, vec3(0.0));
  if (c.uv.x < 0.0 || c.uv.y < 0.0 || c.uv.x > 1.0 || c.uv.y > 1.0) return c;
  vec4 s = textureLod(map, c.uv, c.level);
#if LAYOUT == 2
  c.depth = s.x;
  float cosine = s.y;
  if (cosine <= 0.0) return c;
  vec3 p = unprojectFromMap(view, c.uv, c.depth);
  vec3 irradiance = facingIrradiance(view, lightPower, p);
#else
  if (s.w <= 0.0) return c;
  c.depth = textureLod(mapDepth, c.uv, c.level).x;
  vec3 p = unprojectFromMap(view, c.uv, c.depth);
  float cosine = max(0.0, -dot(lightTravel(view, p), s.xyz));
  vec3 irradiance = lightPower * s.w;
#endif
  float area = windowArea(view, p, c.depth) / (size.x * size.y) * lattice[i].w;
  float entering = cosine * (1.0 - fresnelReflectance(min(1.0, cosine), eta)) * area;
  vec3 Rd = textureLod(profile, vec2(profileCoordinate(distance(p, receiver), profileScale), 0.25), 0.0).xyz;
  c.radiosity = Rd * irradiance * entering;
  return c;
}

vec3 radiosity(LightView view, vec3 receiver) {
  vec2 centre = vec2(projectToMap(view, receiver));
  vec3 sum = vec3(0.0);
  for (int i = 0; i < kCells; ++i) sum += cellOf(view, receiver, centre, i).radiosity;
  return sum;
}
