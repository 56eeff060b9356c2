// The light-space view's uniforms as the struct of lib/light_map.glsl.
#include "lib/light_map.glsl"

uniform vec3 viewOrigin;
uniform vec3 viewRight;
uniform vec3 viewUp;
uniform vec3 viewForward;
uniform float viewHalfWidth;
uniform float viewPerspective;
uniform vec3 lightPower;  // irradiance E0 of parallel light, intensity (in scene units) of a point

LightView lightView() {
  return LightView(viewOrigin, viewRight, viewUp, viewForward, viewHalfWidth, viewPerspective);
}
