// One geometry sample: depth along the camera's axis, octahedral normal, object number (0 = nothing there).
#include "lib/octahedral.glsl"

in vec3 worldPosition;
in vec3 worldNormal;
uniform vec3 cameraPosition;
uniform float objectNumber;

layout(location = 0) out vec4 geometrySample;

void main() {
  vec3 view = normalize(cameraPosition - worldPosition);
  vec3 n = normalize(gl_FrontFacing ? worldNormal : -worldNormal);
  // Behind the horizon an interpolated normal means nothing: the face's own, turned to the camera, stands in, as in
  // the judges.
  if (dot(n, view) < 1e-3) {
    n = normalize(cross(dFdx(worldPosition), dFdy(worldPosition)));
    if (dot(n, view) < 0.0) n = -n;
  }
  geometrySample = vec4(1.0 / gl_FragCoord.w, octEncode(n), objectNumber);
}
