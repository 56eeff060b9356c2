// The translucent shadow map. TWO_CHANNELS (Yao & Wang 2009 sect. 4.1): depth and (w_i . n). FIVE_CHANNELS
// (Dachsbacher & Stamminger 2003): normal and irradiance, and depth. MOMENTS (ours): the flux that enters and its first
// three depth moments, so that every mip level holds exactly what its texels let in; and the two channels, in one go. An
// occluder takes part with its depth only.
#include "lib/fresnel.glsl"
#include "pass/light_view.glsl"

in vec3 worldPosition;
in vec3 worldNormal;
uniform float occluder;  // 1: another object, which blocks the light

#if LAYOUT == 2
layout(location = 0) out vec2 depthAndCosine;
#elif LAYOUT == 4
layout(location = 0) out vec4 fluxMoments;
layout(location = 1) out vec2 depthAndCosine;
uniform float eta;
uniform float centreDepth;
#else
layout(location = 0) out vec4 normalAndIrradiance;
layout(location = 1) out float mapDepth;
#endif

void main() {
  LightView view = lightView();
  vec3 n = normalize(gl_FrontFacing ? worldNormal : -worldNormal);
  float depth = dot(worldPosition - view.origin, view.forward);
  float lit = 1.0 - occluder;
#if LAYOUT != 5
  // Interpolated normals can turn away at the silhouette: what is seen is lit, if only just.
  depthAndCosine = vec2(depth, max(1e-4, -dot(lightTravel(view, worldPosition), n)) * lit);
#endif
#if LAYOUT == 4
  vec3 travel = lightTravel(view, worldPosition);
  // The flat face's own normal, as the judges use it: near grazing the interpolated one lets in another flux altogether.
  vec3 face = normalize(cross(dFdx(worldPosition), dFdy(worldPosition)));
  float cosine = max(1e-4, abs(dot(travel, face)));
  // Per area of the plane across the axis, for irradiance 1 at distance 1: a texel's solid angle goes by the cube.
  float c = dot(travel, view.forward);
  float flux = (1.0 - fresnelReflectance(min(1.0, cosine), eta)) * c * c * c * lit;
  float z = centreDepth - depth;
  fluxMoments = flux * vec4(1.0, z, z * z, z * z * z);
#elif LAYOUT == 5
  vec3 irradiance = facingIrradiance(view, vec3(1.0), worldPosition);
  normalAndIrradiance = vec4(n, irradiance.x) * lit;
  mapDepth = depth;
#endif
}
