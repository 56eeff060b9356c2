// One geometry sample: depth along the camera's axis, octahedral normal, object number (0 = nothing there).
#include "lib/octahedral.glsl"

in vec3 worldNormal;
uniform float objectNumber;

layout(location = 0) out vec4 geometrySample;

void main() {
  vec3 n = normalize(gl_FrontFacing ? worldNormal : -worldNormal);
  geometrySample = vec4(1.0 / gl_FragCoord.w, octEncode(n), objectNumber);
}
